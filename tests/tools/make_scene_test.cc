#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "dpe/engine/scene_io.h"
#include "support/run_program.h"
#include "support/temp_dir.h"

namespace dpe::test {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

// Runs make_scene with --output and the given flags.
class MakeSceneTest : public ::testing::Test {
 protected:
  ProgramResult Run(std::vector<std::string> flags) {
    flags.push_back("--output=" + output_);
    return RunProgram("make_scene", flags);
  }

  Scene Made(const std::vector<std::string>& flags) {
    const ProgramResult result = Run(flags);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_EQ(result.err, "");
    return LoadScene(output_);
  }

  const TempDir folder_;
  const std::string output_ = folder_.File("scene.txt");
};

TEST_F(MakeSceneTest, WritesTheScenesInData) {
  for (const std::string preset : {"side", "corners", "flag", "flag_no_wind"}) {
    const ProgramResult result = Run({"--preset=" + preset});
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_THAT(result.out, HasSubstr("144 vertices, 726 springs, 242 triangles"));
    // Byte by byte on one machine; the positions of another may differ in rounding.
    EXPECT_EQ(ReadFile(output_),
              ReadFile(std::string(DPE_SOURCE_DIR) + "/data/" + preset + ".txt"))
        << "data/" << preset << ".txt is not what data/README.md says it is";
  }
}

TEST_F(MakeSceneTest, FlagsSetWhatTheyName) {
  const Scene scene =
      Made({"--preset=flag", "--rows=4", "--cols=5", "--size=2", "--density=0.5",
            "--damping=0.2", "--drag=0.3", "--delta=0.01", "--frames=7",
            "--integrator=implicit_euler", "--steps_per_frame=3", "--settings=GR",
            "--wind=1,-2,0.5", "--pin_vertices=0,3",
            "--collider_sphere=0,-2,0,1;1,2,3,0.5"});
  const ClothObject& cloth = scene.objects[0];
  EXPECT_EQ(cloth.num_vertices(), 20);
  EXPECT_EQ(cloth.positions.segment<3>(0), Eigen::Vector3d(0.0, -1.0, -1.0));
  EXPECT_NEAR(cloth.mass.sum(), 0.5 * 4.0, 1e-12);
  EXPECT_EQ(cloth.damping, 0.2);
  EXPECT_EQ(cloth.drag_coefficient, 0.3);
  EXPECT_EQ(scene.delta, 0.01);
  EXPECT_EQ(scene.num_frames, 7);
  EXPECT_EQ(scene.integration_method, IntegrationMethod::kImplicitEuler);
  EXPECT_EQ(scene.steps_per_frame, 3);
  EXPECT_EQ(SettingsString(scene), "GR");
  EXPECT_EQ(scene.wind, Eigen::Vector3d(1.0, -2.0, 0.5));
  EXPECT_TRUE(cloth.is_fixed[0] && cloth.is_fixed[3] && !cloth.is_fixed[19]);
  ASSERT_EQ(scene.colliders.size(), 2);
  EXPECT_EQ(scene.colliders[1].position, Eigen::Vector3d(1.0, 2.0, 3.0));
  EXPECT_EQ(scene.colliders[1].scale.x(), 1.0);
}

TEST_F(MakeSceneTest, StiffnessAndFieldsChangeTheSprings) {
  const Eigen::VectorXd plain = Made({"--rows=3", "--cols=3"}).objects[0].stiffness;
  const Eigen::VectorXd stiff =
      Made({"--rows=3", "--cols=3", "--traction_stiffness=100",
            "--bending_stiffness=25"})
          .objects[0]
          .stiffness;
  EXPECT_TRUE(stiff.isApprox(2.0 * plain, 1e-14));
  const ClothObject varied = Made({"--rows=3", "--cols=3", "--stiffness_field=0.5",
                                   "--mass_field=0.1", "--seed=4"})
                                 .objects[0];
  EXPECT_FALSE(varied.stiffness.isApprox(plain, 0.01));
  const ClothObject other = Made({"--rows=3", "--cols=3", "--stiffness_field=0.5",
                                  "--mass_field=0.1", "--seed=5"})
                                .objects[0];
  EXPECT_FALSE(varied.stiffness.isApprox(other.stiffness, 0.01));
}

TEST_F(MakeSceneTest, PinsReplaceThoseOfThePreset) {
  const std::vector<std::string> grid = {"--rows=2", "--cols=3", "--size=2"};
  const auto pins = [&](const std::string& flag) {
    std::vector<std::string> flags = grid;
    flags.push_back(flag);
    return Made(flags).objects[0].is_fixed;
  };
  EXPECT_THAT(pins("--seed=1"), ElementsAre(0, 0, 0, 1, 1, 1));
  EXPECT_THAT(pins("--pin_box=-1,0,-1,0,0,-1;1,0,1,1,0,1"),
              ElementsAre(1, 1, 0, 0, 0, 1));
  EXPECT_THAT(pins("--pin_vertices=none"), ElementsAre(0, 0, 0, 0, 0, 0));
}

TEST_F(MakeSceneTest, TakesTheShapeFromAMesh) {
  const std::string mesh = folder_.File("mesh.obj");
  WriteFile(mesh, "v 0 0 0\nv 1 0 0\nv 1 0 1\nv 0 0 1\nf 1 2 3 4\n");
  const Scene scene = Made({"--mesh=" + mesh, "--pin_vertices=0"});
  EXPECT_EQ(scene.objects[0].num_vertices(), 4);
  EXPECT_EQ(scene.objects[0].num_springs(), 6);
  EXPECT_THAT(scene.objects[0].is_fixed, ElementsAre(1, 0, 0, 0));
  const ProgramResult both = Run({"--mesh=" + mesh, "--rows=3"});
  EXPECT_EQ(both.exit_code, 1);
  EXPECT_THAT(both.err, HasSubstr("--rows is about the grid"));
}

TEST_F(MakeSceneTest, BadFlagsAreRefusedAndNothingIsWritten) {
  const std::pair<const char*, const char*> kWrong[] = {
      {"--preset=sides", "side, corners, flag, flag_no_wind"},
      {"--rows=1", "at least 2"},
      {"--rows=abc", "illegal value 'abc'"},
      {"--rows=1000000", "at most"},
      {"--size=-1", "size -1.0"},
      {"--density=0", "density 0.0"},
      {"--delta=nan", "delta: nan"},
      {"--frames=-3", "optimizationIterations: -3"},
      {"--steps_per_frame=0", "forwardSubSteps: 0"},
      {"--integrator=rk4", "explicit_euler"},
      {"--settings=nQ", "\"Q\""},
      {"--settings=nL,nn", "the scene has 1"},
      {"--wind=1,2", "--wind: \"1,2\""},
      {"--wind=1,2,x", "3 finite numbers"},
      {"--wind=1,2,inf", "3 finite numbers"},
      {"--pin_box=0,0,0", "6 finite numbers"},
      {"--pin_box=50,50,50,60,60,60", "no vertex in the box"},
      {"--pin_vertices=144", "vertex 144"},
      {"--pin_vertices=1.5", "whole numbers"},
      {"--collider_sphere=0,0,0,-1", "colliders[0].scale.x: -2.0"},
      {"--stiffness_field=-1", "sigma -1.0"},
      {"--field_wave_length=0", "wave length 0.0"},
      {"--mesh=absent.obj", "absent.obj"},
      {"--unknown=1", "unknown command line flag 'unknown'"},
      {"leftover", "\"leftover\" is not a flag"},
  };
  for (const auto& [flag, message] : kWrong) {
    const ProgramResult result = Run({flag});
    EXPECT_EQ(result.exit_code, 1) << flag;
    EXPECT_THAT(result.err, HasSubstr(message)) << flag;
    EXPECT_EQ(result.out, "") << flag;
    EXPECT_FALSE(std::filesystem::exists(output_)) << flag;
  }
}

TEST_F(MakeSceneTest, ErrorsNameTheProgramAndTheFile) {
  const ProgramResult missing = RunProgram("make_scene", {});
  EXPECT_EQ(missing.exit_code, 1);
  EXPECT_THAT(missing.err, StartsWith("make_scene: error: --output is missing"));
  const std::string absent = folder_.File("absent") + "/scene.txt";
  const ProgramResult unwritable = RunProgram("make_scene", {"--output", absent});
  EXPECT_EQ(unwritable.exit_code, 1);
  EXPECT_THAT(unwritable.err, AllOf(StartsWith("make_scene: error: " + absent),
                                    HasSubstr("No such file or directory")));
}

TEST_F(MakeSceneTest, WarningsGoToStderr) {
  const ProgramResult result = Run({"--preset=flag", "--drag=0"});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.err, AllOf(StartsWith("make_scene: warning: "),
                                HasSubstr("windVel: no object feels it")));
}

TEST_F(MakeSceneTest, HelpListsTheProgramsOwnFlags) {
  const ProgramResult result = RunProgram("make_scene", {"--help"});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(result.err, "");
  EXPECT_THAT(result.out, AllOf(HasSubstr("Usage: make_scene --preset"),
                                HasSubstr("--pin_box"), HasSubstr("default 0.1)"),
                                Not(HasSubstr("--flagfile")), Not(HasSubstr("--v ("))));
}

}  // namespace
}  // namespace dpe::test
