// --quality: what the presets do to a scene, and to the programs.
#include "dpe/engine/quality.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "dpe/engine/cloth_builder.h"
#include "dpe/engine/stable_step.h"
#include "dpe/estimation/trajectory_io.h"
#include "estimate_cloth_support.h"

namespace dpe::test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

TEST(QualityTest, NamesAndSettings) {
  for (const QualityPreset& preset : QualityPresets()) {
    EXPECT_EQ(QualityFromName(preset.name), preset.quality);
    EXPECT_EQ(PresetOf(preset.quality).name, preset.name);
    EXPECT_NE(preset.estimation.method, IntegrationMethod::kExplicitEuler);
    EXPECT_NE(preset.estimation.method, IntegrationMethod::kSymplecticEuler);
  }
  EXPECT_THROW(QualityFromName("best"), SceneError);
}

TEST(QualityTest, WhatCountsIsTheLengthOfAStep) {
  Scene scene = MakePresetScene(ScenePreset::kSide);
  const StepSettings settings{IntegrationMethod::kTrBdf2, 8, "cg", 1e-7, 1e-6};
  for (const auto& [delta, steps] : std::vector<std::pair<double, int>>{
           {0.02, 8}, {0.04, 16}, {1.0 / 60.0, 7}, {0.001, 1}, {1e-9, 1}}) {
    scene.delta = delta;
    SimulatorOptions options;
    ApplyStepSettings(settings, &scene, &options);
    EXPECT_EQ(scene.steps_per_frame, steps) << delta;
    EXPECT_EQ(options.newton_tolerance, 1e-6);
    EXPECT_EQ(scene.solver, "cg");
    EXPECT_EQ(scene.tolerance, 1e-7);
    EXPECT_EQ(scene.integration_method, IntegrationMethod::kTrBdf2);
  }
}

bool IsStable(Scene scene, double step) {
  scene.integration_method = IntegrationMethod::kSymplecticEuler;
  scene.steps_per_frame = 1;
  scene.delta = step;
  const Trajectory motion = Simulator(scene).Simulate(2000);
  return motion.status.ok() && motion.positions[0].allFinite() &&
         motion.positions[0].cwiseAbs().maxCoeff() < 100.0;
}

TEST(StableStepTest, SymplecticEulerIsStableThereAndNotFarBeyond) {
  PresetOptions preset;
  preset.rows = preset.cols = 6;
  Scene scene = MakePresetScene(ScenePreset::kCorners, preset);
  for (double damping : {0.0, 0.1, 2.0}) {
    for (double stiffness : {1.0, 100.0}) {
      Scene one = scene;
      one.objects[0].damping = damping;
      one.objects[0].stiffness *= stiffness;
      const double limit = StableStep(one);
      EXPECT_TRUE(IsStable(one, limit)) << damping << " " << stiffness;
      EXPECT_FALSE(IsStable(one, 3.0 * limit)) << damping << " " << stiffness;
    }
  }
  // One mode, whose limit is known: a spring between a fixed and a free vertex.
  Scene pair = scene;
  ClothObject& cloth = pair.objects[0];
  cloth.positions = (Eigen::VectorXd(6) << 0, 0, 0, 0, -1, 0).finished();
  cloth.velocities = Eigen::VectorXd::Zero(6);
  cloth.is_fixed = {1, 0};
  cloth.mass = Eigen::VectorXd::Constant(2, 0.5);
  cloth.springs = {{0, 1}};
  cloth.stiffness = Eigen::VectorXd::Constant(1, 200.0);
  cloth.spring_kind.clear();
  cloth.triangles.clear();
  cloth.drag_coefficient = cloth.damping = 0.0;
  EXPECT_NEAR(StableStep(pair), 2.0 / 20.0, 1e-12);
  cloth.damping = 0.6;  // alpha 0.6, beta 0.3: 400 h^2 + (240 + 1.2) h = 4
  const double h = StableStep(pair);
  EXPECT_NEAR(400.0 * h * h + 241.2 * h, 4.0, 1e-12);
  cloth.stiffness.setZero();
  cloth.damping = 0.0;
  EXPECT_TRUE(std::isinf(StableStep(pair)));
}

TEST(QualityTest, ADraftOfAStiffClothTakesShorterStepsOrAnotherMethod) {
  Scene scene = MakePresetScene(ScenePreset::kSide);
  EXPECT_EQ(SimulationSettings(Quality::kDraft, scene).steps, 8);
  scene.objects[0].stiffness *= 2.0;
  const StepSettings shorter = SimulationSettings(Quality::kDraft, scene);
  EXPECT_EQ(shorter.method, IntegrationMethod::kSymplecticEuler);
  EXPECT_GT(shorter.steps, 8);
  EXPECT_LE(0.02 / shorter.steps, StableStep(scene));
  scene.objects[0].stiffness *= 1e4;
  EXPECT_EQ(SimulationSettings(Quality::kDraft, scene).method,
            IntegrationMethod::kTrBdf2);
  Scene hit = MakePresetScene(ScenePreset::kSide);
  const double without = StableStep(hit);
  hit.colliders = {SphereCollider({0.0, -3.0, 0.0}, 1.0)};
  EXPECT_LT(StableStep(hit), without);
  for (Quality quality : {Quality::kDraft, Quality::kStandard}) {
    ApplyStepSettings(SimulationSettings(quality, scene), &scene, nullptr);
    EXPECT_TRUE(Simulator(scene).Simulate(20).status.ok());
  }
}

using QualityProgramsTest = EstimateClothTest;

TEST_F(QualityProgramsTest, SimulateClothTakesThePresetUnlessAFlagSaysMore) {
  const std::string output = folder_.File("out.csv");
  const auto simulate = [&](std::vector<std::string> flags) {
    flags.insert(flags.begin(),
                 {"--scene=" + path_, "--output=" + output, "--frames=6"});
    return RunProgram("simulate_cloth", flags);
  };
  const auto expect = [&](Scene scene, const SimulatorOptions& options) {
    EXPECT_EQ(ReadTrajectoryCsv(output, scene, 0).positions[0],
              Simulator(scene, options).Simulate(6).positions[0]);
  };
  for (const QualityPreset& preset : QualityPresets()) {
    const ProgramResult result = simulate({std::string("--quality=") + preset.name});
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_THAT(result.out, HasSubstr(std::string("Quality ") + preset.name));
    Scene scene = scene_;
    SimulatorOptions options;
    ApplyStepSettings(SimulationSettings(preset.quality, scene_), &scene, &options);
    expect(scene, options);
  }
  const ProgramResult result = simulate(
      {"--quality=accurate", "--integrator=implicit_euler", "--steps_per_frame=3"});
  EXPECT_THAT(result.out, HasSubstr("implicit_euler, 3 steps"));
  Scene scene = scene_;
  SimulatorOptions options;
  ApplyStepSettings(PresetOf(Quality::kAccurate).simulation, &scene, &options);
  scene.integration_method = IntegrationMethod::kImplicitEuler;
  scene.steps_per_frame = 3;
  expect(scene, options);
  ASSERT_EQ(simulate({}).exit_code, 0);
  expect(scene_, {});  // the scene's own, as ever
  const ProgramResult bad = simulate({"--quality=best"});
  EXPECT_EQ(bad.exit_code, 1);
  EXPECT_THAT(bad.err, AllOf(HasSubstr("--quality"), HasSubstr("best"),
                             HasSubstr("draft, standard, accurate or reference")));
  EXPECT_THAT(RunProgram("simulate_cloth", {"--help"}).out, HasSubstr("win"));
}

// Without a target the motion to recover is made with the quality, too: nothing but
// rounding is left. With the motion of another quality the parameters are off.
TEST_F(QualityProgramsTest, EstimateClothMakesItsTargetAtTheQuality) {
  ApplySettings("nG", &scene_);
  scene_.objects[0].stiffness.setConstant(20.0);
  SaveScene(scene_, path_);
  const ProgramResult own = Run({"--quality=standard"});
  EXPECT_EQ(own.exit_code, 0) << own.err;
  EXPECT_THAT(own.out, HasSubstr("Quality standard: tr_bdf2, 4 steps per frame"));
  EXPECT_EQ(Report()["quality"], "standard");
  EXPECT_EQ(Report()["integrator"], "tr_bdf2");
  EXPECT_EQ(Report()["steps_per_frame"], 4);
  EXPECT_LT(Report()["parameter_deviation_percent"].get<double>(), 1e-6);
  const Scene written = LoadScene(output_ + "/cloth.v1_nG_optimized.txt");
  EXPECT_EQ(written.integration_method, IntegrationMethod::kTrBdf2);
  EXPECT_EQ(written.steps_per_frame, 4);

  ASSERT_EQ(Run({}).exit_code, 0);
  EXPECT_TRUE(Report()["quality"].is_null());
  EXPECT_EQ(Report()["integrator"], IntegrationMethodName(scene_.integration_method));

  const std::string truth = folder_.File("truth.csv");
  ASSERT_EQ(RunProgram("simulate_cloth",
                       {"--scene=" + path_, "--output=" + truth, "--quality=reference"})
                .exit_code,
            0);
  const auto deviation = [&](const std::string& quality) {
    EXPECT_EQ(Run({"--target=" + truth, "--quality=" + quality}).exit_code, 0);
    const double value = Report()["parameters"][0]["values"][0].get<double>();
    return std::abs(value / 20.0 - 1.0);
  };
  const double draft = deviation("draft"), accurate = deviation("accurate");
  EXPECT_GT(draft, 1e-7);
  EXPECT_LT(accurate, 0.2 * draft);
}

TEST_F(QualityProgramsTest, EstimateClothRefusesWhatIsNoQuality) {
  const ProgramResult bad = Run({"--quality=best"});
  EXPECT_EQ(bad.exit_code, 1);
  EXPECT_THAT(bad.err, AllOf(HasSubstr("--quality"), HasSubstr("reference")));
}

}  // namespace
}  // namespace dpe::test
