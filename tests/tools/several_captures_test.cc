// estimate_cloth on several captures of one cloth.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <set>

#include "dpe/engine/cloth_builder.h"
#include "dpe/engine/parameters.h"
#include "dpe/engine/simulator.h"
#include "dpe/estimation/trajectory_io.h"
#include "tools/estimate_cloth_support.h"

namespace dpe::test {
namespace {

using ::testing::AllOf;
using ::testing::Each;
using ::testing::HasSubstr;
using ::testing::Not;

// One cloth that hangs from a side (a.txt, a.csv, 20 frames) and from two corners
// (b.txt, b.csv, 25 frames).
class SeveralCapturesTest : public ::testing::Test {
 protected:
  SeveralCapturesTest() {
    Scene side = MakeDerivativeScene("side", 5);
    ApplySettings("nR", &side);
    side.objects[0].estimate_damping = true;
    Eigen::VectorXd truth(4);
    truth << 45.0, 25.0, 6.0, 0.1;
    ParameterLayout(side).Insert(truth, &side);
    Scene corners = side;
    UnpinAll(&corners.objects[0]);
    PinVertices({0, 20}, &corners.objects[0]);
    // Also the springs that the side holds fixed.
    ParameterLayout(corners).Insert(truth, &corners);
    Write(side, "a", 20);
    Write(corners, "b", 25);
    truth_ = truth;
  }

  void Write(Scene scene, const std::string& name, int frames) {
    scene.num_frames = frames;
    SaveScene(scene, File(name + ".txt"));
    WriteTrajectory(File(name + ".csv"), TrajectoryFormat::kCsv,
                    Simulator(scene).Simulate(frames), scene);
  }

  std::string File(const std::string& name) const { return folder_.File(name); }

  ProgramResult Run(std::vector<std::string> flags) const {
    flags.push_back("--init=uniform:10");
    flags.push_back("--output_dir=" + output_);
    return RunProgram("estimate_cloth", flags);
  }

  // Of both, by repeated flags.
  ProgramResult RunBoth(std::vector<std::string> flags = {}) const {
    for (const std::string name : {"a", "b"}) {
      flags.push_back("--scene=" + File(name + ".txt"));
      flags.push_back("--target=" + File(name + ".csv"));
    }
    return Run(std::move(flags));
  }

  std::string Refused(const std::vector<std::string>& flags) const {
    const ProgramResult result = Run(flags);
    EXPECT_EQ(result.exit_code, 1) << result.out;
    EXPECT_FALSE(std::filesystem::exists(output_ + "/report.json"));
    return result.err;
  }

  nlohmann::json Report() const {
    return nlohmann::json::parse(ReadFile(output_ + "/report.json"));
  }

  std::set<std::string> OutputNames() const {
    std::set<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(output_)) {
      names.insert(entry.path().filename().string());
    }
    return names;
  }

  const TempDir folder_;
  const std::string output_ = folder_.File("out");
  Eigen::VectorXd truth_;
};

TEST_F(SeveralCapturesTest, RecoversOneClothAndWritesWhatIsOfEach) {
  const ProgramResult result = RunBoth({"--validate_frames=22", "--sigma=0.001"});
  ASSERT_EQ(result.exit_code, 0) << result.err << result.out;
  EXPECT_EQ(result.err, "");
  SCOPED_TRACE(result.out);
  EXPECT_THAT(result.out,
              AllOf(HasSubstr("4 parameters to fit to 2 captures"),
                    HasSubstr("Capture 1: scene " + File("a.txt") + ", 20 frames of " +
                              File("a.csv")),
                    HasSubstr("Capture 2: scene " + File("b.txt") + ", 25 frames of " +
                              File("b.csv")),
                    HasSubstr("  capture 1: "), HasSubstr(" m over 20 frames, "),
                    HasSubstr("  capture 2: "), HasSubstr(" over 22 (validation)")));
  EXPECT_EQ(OutputNames(),
            std::set<std::string>({"report.json", "scene_1.txt", "scene_2.txt",
                                   "trajectory_1.csv", "trajectory_2.csv"}));
  const nlohmann::json report = Report();
  EXPECT_EQ(report.at("success"), true);
  EXPECT_TRUE(report.at("scene").is_null());
  EXPECT_TRUE(report.at("target").is_null());
  EXPECT_EQ(report.at("frames"), 25);
  ASSERT_EQ(report.at("captures").size(), 2u);
  for (const size_t c : {0, 1}) {
    const nlohmann::json& capture = report.at("captures")[c];
    const std::string name = c == 0 ? "a" : "b";
    EXPECT_EQ(capture.at("scene"), File(name + ".txt"));
    EXPECT_EQ(capture.at("target"), File(name + ".csv"));
    EXPECT_EQ(capture.at("frames"), c == 0 ? 20 : 25);
    EXPECT_EQ(capture.at("sigma_m"), 0.001);
    EXPECT_LT(capture.at("rms_position_error_m"), 1e-8);
    EXPECT_EQ(capture.at("validation").at("frames"), c == 0 ? 20 : 22);
    EXPECT_LT(capture.at("validation").at("rms_position_error_m"), 1e-8);
  }
  // Each scene is its capture's with the shared estimates, and makes its trajectory.
  for (const std::string which : {"1", "2"}) {
    const Scene fitted = LoadScene(output_ + "/scene_" + which + ".txt");
    EXPECT_LT((ParameterLayout(fitted).Extract(fitted) - truth_).norm(), 1e-5);
    EXPECT_EQ(fitted.objects[0].is_fixed[0] != 0, which == "2");
    const std::string again = File("again.csv");
    ASSERT_EQ(RunProgram("simulate_cloth",
                         {"--scene=" + output_ + "/scene_" + which + ".txt",
                          "--frames=" + std::string(which == "1" ? "20" : "25"),
                          "--output=" + again})
                  .exit_code,
              0);
    EXPECT_EQ(ReadFile(again), ReadFile(output_ + "/trajectory_" + which + ".csv"));
  }
}

TEST_F(SeveralCapturesTest, ListsAndRepeatedFlagsAreTheSame) {
  ASSERT_EQ(RunBoth().exit_code, 0);
  const nlohmann::json repeated = Report().at("parameters");
  ASSERT_EQ(Run({"--scene", File("a.txt") + "," + File("b.txt"), "--threads=2",
                 "-target=" + File("a.csv") + "," + File("b.csv")})
                .exit_code,
            0);
  EXPECT_EQ(Report().at("parameters"), repeated);
  EXPECT_EQ(Report().at("captures").size(), 2u);
  // Without targets: the scenes' own motions, which are the same.
  ASSERT_EQ(Run({"--scene=" + File("a.txt") + "," + File("b.txt")}).exit_code, 0);
  EXPECT_EQ(Report().at("parameters")[0].at("values"), repeated[0].at("values"));
  EXPECT_LT(Report().at("parameter_deviation_percent"), 1e-5);
}

TEST_F(SeveralCapturesTest, OneSceneServesAllTargetsWithAStartOfEach) {
  // The cloth is let go from two places.
  Scene scene = LoadScene(File("a.txt"));
  for (const std::string name : {"left", "right"}) {
    Scene moved = scene;
    ClothObject& cloth = moved.objects[0];
    cloth.rest_length = RestLengths(cloth);
    for (int v = 0; v < cloth.num_vertices(); ++v) {
      if (cloth.is_fixed[v] || name == "left") continue;
      cloth.positions[3 * v + 1] += 0.02 * (v % 3);
    }
    WriteTrajectory(File(name + ".csv"), TrajectoryFormat::kCsv,
                    Simulator(moved).Simulate(20), moved);
  }
  const ProgramResult result =
      Run({"--scene=" + File("a.txt"), "--target=" + File("left.csv"),
           "--target=" + File("right.csv"), "--initial_state=target",
           "--trajectory_format=obj"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_LT(Report().at("rms_position_error_m"), 1e-8);
  EXPECT_THAT(Report().at("captures")[1].at("scene"), File("a.txt"));
  EXPECT_TRUE(OutputNames().count("trajectory_1_0000.obj"));
  EXPECT_TRUE(OutputNames().count("trajectory_2_0019.obj"));
}

TEST_F(SeveralCapturesTest, MeshesMakeASceneEach) {
  const Scene scene = LoadScene(File("a.txt"));
  for (const std::string name : {"one", "two"}) {
    WriteTrajectory(File(name + "/*.obj"), TrajectoryFormat::kObj,
                    Simulator(scene).Simulate(12), scene);
  }
  const ProgramResult result = Run(
      {"--target=" + File("one") + "," + File("two"), "--target_rate=50",
       "--settings=nG", "--max_iterations=3", "--validate_frames=12", "--frames=10"});
  EXPECT_EQ(result.exit_code, 2) << result.err;
  EXPECT_THAT(result.out, AllOf(HasSubstr("Capture 2: scene made of the target, 10 "),
                                HasSubstr(" m over the 2 held out")));
  const nlohmann::json capture = Report().at("captures").at(1);
  EXPECT_TRUE(capture.at("scene").is_null());
  EXPECT_EQ(capture.at("target"), File("two"));
  EXPECT_GT(capture.at("validation").at("held_out_rms_position_error_m"), 0.0);
  EXPECT_GT(capture.at("growth"), 0.0);
}

TEST_F(SeveralCapturesTest, CommasInTheNameOfAFileDoNotSplitIt) {
  const std::string scene = File("a,1.txt"), target = File("x,y/a,b.csv");
  std::filesystem::create_directory(File("x,y"));
  std::filesystem::rename(File("a.txt"), scene);
  std::filesystem::rename(File("a.csv"), target);
  const ProgramResult result = Run({"--scene=" + scene, "--target=" + target});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(Report().at("scene"), scene);
  EXPECT_EQ(Report().at("target"), target);
  // Nor those of a pattern; and where both are needed, flags are repeated.
  WriteTrajectory(File("x,y/*.obj"), TrajectoryFormat::kObj,
                  Simulator(LoadScene(scene)).Simulate(20), LoadScene(scene));
  for (const int count : {1, 2}) {
    std::vector<std::string> flags = {"--scene=" + scene};
    flags.resize(1 + count, "--target=" + File("x,y/*.obj"));
    const ProgramResult of_pattern = Run(flags);
    EXPECT_EQ(of_pattern.exit_code, 0) << of_pattern.err;
    EXPECT_EQ(static_cast<int>(Report().at("captures").size()), count);
  }
}

TEST_F(SeveralCapturesTest, WhatDoesNotBelongTogetherIsRefused) {
  const std::string a = "--scene=" + File("a.txt"), b = "--scene=" + File("b.txt");
  const std::string target = "--target=" + File("a.csv");
  EXPECT_THAT(Refused({a, b, target, target, target}),
              AllOf(HasSubstr("2 scenes and 3 targets"),
                    HasSubstr("a target for each scene, one scene for all targets")));
  EXPECT_THAT(Refused({a, b, target}), HasSubstr("2 scenes and 1 targets"));
  EXPECT_THAT(Refused({a, target, "--target="}),
              AllOf(HasSubstr("--target"), HasSubstr("one of its 2 paths is empty")));
  EXPECT_THAT(Refused({a, "--target=" + File("a.csv") + "," + File("absent.csv")}),
              AllOf(HasSubstr(File("absent.csv")), Not(HasSubstr("a.csv,"))));
  EXPECT_THAT(Refused({a, b, target, "--target=" + File("b.csv"), "--frames=26"}),
              AllOf(HasSubstr("accepted are 2 to 25"), HasSubstr(File("b.csv"))));

  // Another mesh, and another rest length: both files, the place and the values.
  Scene other = MakeDerivativeScene("side", 4);
  ApplySettings("nR", &other);
  SaveScene(other, File("c.txt"));
  const std::string mesh = Refused({a, "--scene=" + File("c.txt")});
  EXPECT_THAT(mesh,
              AllOf(HasSubstr("capture 1 (" + File("a.txt") + ")"),
                    HasSubstr("capture 2 (" + File("c.txt") + ")"),
                    HasSubstr("number of vertices is 25 in"), HasSubstr("and 16 in")));
  other = LoadScene(File("b.txt"));
  other.objects[0].positions *= 1.01;
  SaveScene(other, File("c.txt"));
  EXPECT_THAT(Refused({a, "--scene=" + File("c.txt")}),
              HasSubstr("objects[0].springRestLength[0] is "));
}

TEST_F(SeveralCapturesTest, AFitIsContinued) {
  const std::string checkpoint = File("fit.json");
  ASSERT_EQ(RunBoth().exit_code, 0);
  const nlohmann::json expected = Report().at("parameters");
  EXPECT_EQ(RunBoth({"--checkpoint=" + checkpoint, "--max_iterations=4"}).exit_code, 2);
  EXPECT_NE(Report().at("parameters"), expected);
  const ProgramResult resumed = RunBoth({"--resume=" + checkpoint});
  EXPECT_EQ(resumed.exit_code, 0) << resumed.err;
  for (size_t b = 0; b < expected.size(); ++b) {
    const std::vector<double> values = Report().at("parameters")[b].at("values");
    for (size_t i = 0; i < values.size(); ++i) {
      const double value = expected[b].at("values")[i];
      EXPECT_NEAR(values[i], value, 1e-6 * value);
    }
  }
  std::filesystem::remove_all(output_);
  EXPECT_THAT(Refused({"--resume=" + checkpoint, "--scene=" + File("b.txt"),
                       "--scene=" + File("a.txt"), "--target=" + File("b.csv"),
                       "--target=" + File("a.csv")}),
              AllOf(HasSubstr("another fit"), HasSubstr("target 1 (")));
}

TEST_F(SeveralCapturesTest, WindsAreNamedByTheirCapture) {
  const ProgramResult result = RunBoth({"--settings=nG", "--estimate=wind"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, AllOf(HasSubstr("capture 1 scene wind ("),
                                HasSubstr("capture 2 scene wind ("),
                                HasSubstr("the wind along x in capture 2: ")));
  const nlohmann::json parameters = Report().at("parameters");
  ASSERT_EQ(parameters.size(), 4u);
  EXPECT_TRUE(parameters[0].at("capture").is_null());
  EXPECT_EQ(parameters[2].at("capture"), 1);
  EXPECT_EQ(parameters[3].at("capture"), 2);
  EXPECT_EQ(Report().at("uncertainty").at("parameters")[3].at("capture"), 2);
}

}  // namespace
}  // namespace dpe::test
