// What only_what_it_requires says and how it counts. That absent features cost nothing
// is in absent_terms_test.cc and, for all of them, in requirements_long_test.cc.
#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include "dpe/engine/scene.h"
#include "dpe/engine/scene_io.h"
#include "experiments/requirements/cost_configuration.h"
#include "experiments/requirements/cost_job.h"
#include "experiments/requirements/features.h"
#include "experiments/requirements/instruction_count.h"
#include "experiments/requirements/timed_program.h"

namespace dpe::experiments {
namespace {

TEST(InstructionCountTest, AnAnnotationIsReadWithoutTheCLibrary) {
  const InstructionCount count = ParseAnnotation(
      "Ir                file:function\n"
      "6,539,011 (100.0%)  PROGRAM TOTALS\n"
      "768,389 (11.75%)  ./memset.S:__memset_avx2 [/usr/lib/libc.so.6]\n"
      "743,103 (11.36%)  ???:dpe::DragLaw::Panel(int, int) [/bin/simulate_cloth]\n"
      "     93 ( 0.00%)  ???:dpe::Other(dpe::Drag const&) [/bin/simulate_cloth]\n");
  EXPECT_EQ(count.total, 743103 + 93);
  ASSERT_EQ(count.functions.size(), 2u);
  EXPECT_EQ(count.In({"DragLaw", "Panel"}), 743103);
  EXPECT_EQ(count.In({"Drag"}), 743103 + 93);
  EXPECT_EQ(count.In({"Collider"}), 0);
}

TEST(InstructionCountTest, WhatCannotBeCountedIsAnError) {
  std::string why;
  if (!CanCountInstructions(&why)) GTEST_SKIP() << why;
  EXPECT_THROW(CountInstructions({"/bin/true"}, {"dpe::Nothing"}), std::runtime_error);
  EXPECT_THROW(CountInstructions({"/bin/false"}, {"main"}), std::runtime_error);
}

TEST(TimedProgramTest, ExitCodesSignalsAndOutput) {
  const TimedResult result = RunTimed({"sh", "-c", "echo a; echo b >&2; exit 3"});
  EXPECT_EQ(result.exit_code, 3);
  EXPECT_EQ(result.out, "a\n");
  EXPECT_EQ(result.err, "b\n");
  EXPECT_EQ(RunTimed({"sh", "-c", "kill -9 $$"}).exit_code, -9);
  EXPECT_THROW(RunTimed({"/no/such/program"}), std::runtime_error);
  const TimedResult busy =
      RunTimed({"sh", "-c", "i=0; while [ $i -lt 200000 ]; do i=$((i+1)); done"});
  EXPECT_GT(busy.cpu_s, 0.01);
}

TEST(CostConfigurationTest, EveryFeatureComparesConfigurationsThatThereAre) {
  std::set<std::string> ids, codes = {""};
  for (const Job& job : CostConfigurations()) {
    EXPECT_TRUE(ids.insert(job.Text("id", "")).second) << job.Text("id", "");
    EXPECT_NO_THROW(CostSceneText(job)) << job.Text("id", "");
  }
  for (const FeatureCode& code : CodeOfFeatures()) codes.insert(code.name);
  std::set<std::string> used;
  for (const Feature& feature : ComparedFeatures()) {
    for (const std::string& id :
         {feature.impossible, feature.off, feature.on, feature.without}) {
      EXPECT_TRUE(id.empty() || ids.count(id) == 1) << feature.name << ": " << id;
      used.insert(id);
    }
    EXPECT_FALSE(feature.off.empty() || feature.on.empty()) << feature.name;
    EXPECT_EQ(codes.count(feature.code), 1u) << feature.name;
  }
  for (const std::string& id : ids) EXPECT_EQ(used.count(id), 1u) << id;
}

TEST(CostConfigurationTest, ASceneHasWhatIsAskedForAndNothingElse) {
  const Scene bare = ParseScene(CostSceneText({}), "bare");
  EXPECT_TRUE(bare.objects[0].triangles.empty());
  EXPECT_TRUE(bare.colliders.empty());
  EXPECT_EQ(bare.wind.norm(), 0.0);
  Job job;
  job.Set("rows", 4);
  job.Set("objects", 2);
  job.Set("colliders", 3);
  job.Set("drag", 0.5);
  job.Set("triangles", true);
  job.Set("unmentioned", "windVel");
  const Scene scene = ParseScene(CostSceneText(job), "full");
  EXPECT_EQ(scene.objects.size(), 2u);
  EXPECT_EQ(scene.objects[1].num_vertices(), 16);
  EXPECT_EQ(scene.objects[1].drag_coefficient, 0.5);
  EXPECT_EQ(scene.colliders.size(), 3u);
  EXPECT_EQ(CostSceneText(job).find("windVel"), std::string::npos);
  job.Set("unmentioned", "nonsense");
  EXPECT_THROW(CostSceneText(job), SceneError);
  job.Set("program", "rm");
  EXPECT_THROW(CostCommand(job, "a", "b", 3), SceneError);
}

TEST(FeatureTableTest, RowsBecomeRatiosAndFailuresDashes) {
  std::vector<Row> rows;
  double instructions = 1e6;
  for (const Job& job : CostConfigurations()) {
    Row row = job;
    if (job.Text("id", "") != "sim-damping_on") {
      row.Set("instructions", instructions);
      row.Set("code_drag", job.Text("id", "") == "sim-drag_on" ? 77.0 : 0.0);
      row.Set("program_cpu_s", job.Text("id", "") == "sim-drag_on" ? 0.3 : 0.2);
      row.Set("rollouts", 1);
      row.Set("time_frames", 100);
    }
    rows.push_back(row);
    if (job.Text("id", "") == "sim-drag_off") instructions = 2e6;
  }
  const Results results = OnlyWhatItRequires().results(rows);
  ASSERT_EQ(results.tables.size(), 1u);
  const auto& cells = results.tables[0].cells;
  ASSERT_EQ(cells.size(), ComparedFeatures().size());
  const std::vector<std::string> drag = {"drag",  "1.00000", "0",      "77",
                                         "2.000", "2.0000",  "+1.0000"};
  EXPECT_EQ(cells[0], drag);
  EXPECT_EQ(cells[2][0], "damping");
  EXPECT_EQ(cells[2][4], "–");
  ASSERT_EQ(results.plots.size(), 1u);
  EXPECT_EQ(results.plots[0].series[0].x[0], 2.0);
}

TEST(CostJobTest, CountsAndMeasuresAConfiguration) {
  std::string why;
  if (!CanCountInstructions(&why)) GTEST_SKIP() << why;
  Job job;
  job.Set("rows", 6);
  job.Set("frames", 5);
  job.Set("time_frames", 5);
  job.Set("repetitions", 1);
  job.Set("colliders", 1);
  const Record one = CostJobKind().run(job);
  EXPECT_GT(one.Number("instructions", 0.0), 1e5);
  EXPECT_GT(one.Number("program_cpu_s", 0.0), 0.0);
  EXPECT_GT(one.Number("code_collider", 0.0), 1e3);
  EXPECT_EQ(one.Number("code_drag", -1.0), 0.0);
}

}  // namespace
}  // namespace dpe::experiments
