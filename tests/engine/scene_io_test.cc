#include "dpe/engine/scene_io.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <limits>
#include <random>

#include "dpe/engine/cloth_builder.h"
#include "support/scene_text.h"
#include "support/temp_dir.h"

namespace dpe::test {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::StartsWith;

template <typename Values>
bool SameBits(const Values& a, const Values& b) {
  if (a.rows() != b.rows() || a.cols() != b.cols()) return false;
  // Nothing has no address, which memcmp must not be given.
  return a.size() == 0 ||
         std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0;
}

bool SameBits(double a, double b) { return std::memcmp(&a, &b, sizeof(a)) == 0; }

void ExpectSameObject(const ClothObject& a, const ClothObject& b) {
  EXPECT_TRUE(SameBits(a.positions, b.positions));
  EXPECT_TRUE(SameBits(a.velocities, b.velocities));
  EXPECT_EQ(a.is_fixed, b.is_fixed);
  EXPECT_TRUE(SameBits(a.mass, b.mass));
  EXPECT_EQ(a.springs, b.springs);
  EXPECT_TRUE(SameBits(a.stiffness, b.stiffness));
  EXPECT_TRUE(SameBits(a.rest_length, b.rest_length));
  EXPECT_EQ(a.spring_kind, b.spring_kind);
  EXPECT_EQ(a.spring_group, b.spring_group);
  EXPECT_EQ(a.vertex_group, b.vertex_group);
  EXPECT_EQ(a.triangles, b.triangles);
  EXPECT_TRUE(SameBits(a.drag_coefficient, b.drag_coefficient));
  EXPECT_TRUE(SameBits(a.damping, b.damping));
  ASSERT_EQ(a.prescribed_paths.size(), b.prescribed_paths.size());
  for (size_t p = 0; p < a.prescribed_paths.size(); ++p) {
    EXPECT_EQ(a.prescribed_paths[p].vertex, b.prescribed_paths[p].vertex);
    EXPECT_TRUE(
        SameBits(a.prescribed_paths[p].positions, b.prescribed_paths[p].positions));
  }
  EXPECT_EQ(a.mass_mode, b.mass_mode);
  EXPECT_EQ(a.stiffness_mode, b.stiffness_mode);
  EXPECT_EQ(a.estimate_damping, b.estimate_damping);
  EXPECT_EQ(a.estimate_drag, b.estimate_drag);
  EXPECT_EQ(a.estimate_initial_velocity, b.estimate_initial_velocity);
  EXPECT_EQ(a.estimate_initial_position, b.estimate_initial_position);
}

void ExpectSameCollider(const Collider& a, const Collider& b) {
  EXPECT_EQ(a.type, b.type);
  EXPECT_TRUE(SameBits(a.position, b.position));
  EXPECT_TRUE(SameBits(a.rotation_degrees, b.rotation_degrees));
  EXPECT_TRUE(SameBits(a.scale, b.scale));
  EXPECT_TRUE(SameBits(a.stiffness, b.stiffness));
}

void ExpectSameScene(const Scene& a, const Scene& b) {
  EXPECT_EQ(a.title, b.title);
  EXPECT_TRUE(SameBits(a.delta, b.delta));
  EXPECT_EQ(a.integration_method, b.integration_method);
  EXPECT_TRUE(SameBits(a.tolerance, b.tolerance));
  EXPECT_EQ(a.num_frames, b.num_frames);
  EXPECT_EQ(a.steps_per_frame, b.steps_per_frame);
  EXPECT_EQ(a.print_times, b.print_times);
  EXPECT_TRUE(SameBits(a.wind, b.wind));
  EXPECT_TRUE(SameBits(a.gravity, b.gravity));
  EXPECT_EQ(a.aerodynamics, b.aerodynamics);
  EXPECT_EQ(a.solver, b.solver);
  EXPECT_EQ(a.estimate_wind, b.estimate_wind);
  ASSERT_EQ(a.objects.size(), b.objects.size());
  for (size_t i = 0; i < a.objects.size(); ++i) {
    ExpectSameObject(a.objects[i], b.objects[i]);
  }
  ASSERT_EQ(a.colliders.size(), b.colliders.size());
  for (size_t i = 0; i < a.colliders.size(); ++i) {
    ExpectSameCollider(a.colliders[i], b.colliders[i]);
  }
}

// Every field differs from its default, with numbers that are hard to print.
Scene SceneWithEverything() {
  Scene scene = MakePresetScene(ScenePreset::kCorners, {4, 5, 1.0 / 3.0, {}});
  scene.title = "quotes \" and \\ and \xc3\xa9";
  scene.delta = 1.0 / 60.0;
  scene.integration_method = IntegrationMethod::kImplicitEuler;
  scene.tolerance = 1e-300;
  scene.num_frames = std::numeric_limits<int>::max();
  scene.steps_per_frame = 7;
  scene.print_times = true;
  scene.wind = {1e300, -0.0, 4.9e-324};
  scene.gravity = {0.1, -1.62, 0.0};
  scene.aerodynamics = AerodynamicsLaw::kUnitNormal;
  scene.solver = "cg";
  scene.estimate_wind = true;
  scene.colliders = {SphereCollider({0.1, 0.2, 0.3}, 0.7), Collider()};
  scene.colliders[1].type = ColliderType::kPlane;
  scene.colliders[1].rotation_degrees = {10.0, 20.0, 30.0};
  scene.colliders[1].stiffness = 0.1;
  scene.objects.push_back(scene.objects[0]);

  ClothObject& object = scene.objects[0];
  std::mt19937 generator(7);
  std::uniform_real_distribution<double> uniform(0.1, 1.0);
  for (double& mass : object.mass) mass = uniform(generator);
  for (double& velocity : object.velocities) velocity = uniform(generator) - 0.5;
  object.spring_kind.clear();
  object.rest_length.resize(object.num_springs());
  for (double& length : object.rest_length) length = uniform(generator);
  object.mass_mode = ParameterMode::kGroup;
  object.stiffness_mode = ParameterMode::kGlobal;
  object.estimate_damping = object.estimate_drag = true;
  object.estimate_initial_velocity = object.estimate_initial_position = true;
  for (int v = 0; v < object.num_vertices(); ++v) object.vertex_group.push_back(v % 3);
  for (int s = 0; s < object.num_springs(); ++s) object.spring_group.push_back(s % 4);
  object.prescribed_paths.push_back({0, Eigen::Matrix3Xd::Constant(3, 2, 0.7)});
  scene.objects[1].velocities[2] = -0.0;
  return scene;
}

TEST(SceneIo, WhatIsSavedReadsBackBitByBit) {
  const Scene scene = SceneWithEverything();
  const std::string text = SceneToJson(scene);
  const Scene read = ParseScene(text, "scene.txt");
  ExpectSameScene(scene, read);
  EXPECT_EQ(SceneToJson(read), text);
}

TEST(SceneIo, SavesAndLoadsFiles) {
  const TempDir folder;
  const std::string path = folder.File("scene.txt");
  SaveScene(SceneWithEverything(), path);
  ExpectSameScene(SceneWithEverything(), LoadScene(path));
}

TEST(SceneIo, ReadsTheLegacyKeys) {
  std::vector<std::string> warnings;
  const Scene scene = ParseScene(SmallSceneText(), "scene.txt", &warnings);
  EXPECT_THAT(warnings, IsEmpty());
  EXPECT_EQ(scene.title, "small");
  EXPECT_EQ(scene.delta, 0.02);
  EXPECT_EQ(scene.integration_method, IntegrationMethod::kLinearlyImplicitEuler);
  EXPECT_EQ(scene.tolerance, 1e-5);
  EXPECT_EQ(scene.num_frames, 10);
  EXPECT_EQ(scene.steps_per_frame, 3);
  EXPECT_TRUE(scene.print_times);
  EXPECT_EQ(scene.wind, Eigen::Vector3d(1.5, 0.0, -2.0));
  ASSERT_EQ(scene.objects.size(), 1);
  const ClothObject& object = scene.objects[0];
  EXPECT_EQ(object.positions[3], 1.0);
  EXPECT_EQ(object.positions[8], 1.0);
  EXPECT_THAT(object.is_fixed, ElementsAre(1, 0, 0));
  EXPECT_EQ(object.mass, Eigen::Vector3d(0.5, 0.25, 0.125));
  EXPECT_EQ(object.springs[1], (std::array<int, 2>{1, 2}));
  EXPECT_EQ(object.stiffness, Eigen::Vector2d(10.0, 20.0));
  EXPECT_EQ(object.triangles[0], (std::array<int, 3>{0, 1, 2}));
  EXPECT_EQ(object.drag_coefficient, 0.3);
  EXPECT_EQ(object.damping, 0.2);
  EXPECT_EQ(object.mass_mode, ParameterMode::kFixed);
  EXPECT_EQ(object.stiffness_mode, ParameterMode::kLocal);
  ASSERT_EQ(scene.colliders.size(), 1);
  EXPECT_EQ(scene.colliders[0].type, ColliderType::kSphere);
  EXPECT_EQ(scene.colliders[0].position.y(), -3.0);
  EXPECT_EQ(scene.colliders[0].scale.x(), 2.0);
}

TEST(SceneIo, AddedKeysHaveDefaults) {
  const Scene scene = ParseScene(SmallSceneText(), "scene.txt");
  EXPECT_EQ(scene.gravity, Eigen::Vector3d(0.0, -9.81, 0.0));
  EXPECT_EQ(scene.aerodynamics, AerodynamicsLaw::kAuthored);
  EXPECT_EQ(scene.solver, "auto");
  EXPECT_FALSE(scene.estimate_wind);
  EXPECT_EQ(scene.colliders[0].stiffness, 1000.0);
  const ClothObject& object = scene.objects[0];
  EXPECT_EQ(object.velocities, Eigen::VectorXd::Zero(9));
  EXPECT_EQ(object.rest_length.size(), 0);
  EXPECT_THAT(object.spring_group, IsEmpty());
  EXPECT_THAT(object.vertex_group, IsEmpty());
  EXPECT_THAT(object.spring_kind, IsEmpty());
  EXPECT_THAT(object.prescribed_paths, IsEmpty());
}

TEST(SceneIo, ASceneNeedsOnlyDeltaPositionsAndMasses) {
  const Scene scene = ParseScene(
      R"({"delta": 0.1, "objects": [{"vertPos": [{"x": 1, "y": 2, "z": 3}],
          "vertMass": [4]}]})",
      "scene.txt");
  EXPECT_EQ(scene.objects[0].positions, Eigen::Vector3d(1.0, 2.0, 3.0));
  EXPECT_THAT(scene.objects[0].is_fixed, ElementsAre(0));
  EXPECT_EQ(SettingsString(scene), "");
  EXPECT_THAT(scene.colliders, IsEmpty());
}

TEST(SceneIo, OptionalKeysAreWrittenOnlyWhereTheyDifferFromTheirDefault) {
  const std::string text = SceneToJson(ParseScene(SmallSceneText(), "scene.txt"));
  for (const char* key :
       {"gravity", "aerodynamics", "solver", "estimate", "springGroup", "vertexGroup",
        "springKind", "springRestLength", "vertVel", "prescribedPaths",
        "\"stiffness\""}) {
    EXPECT_EQ(text.find(key), std::string::npos) << key;
  }
}

TEST(SceneIo, AcceptsCommentsNamesAndWholeNumbersWrittenAsDecimals) {
  EXPECT_EQ(SceneErrorOf(EditedSceneText("\"objects\"", "// pinned\n\"objects\"")), "");
  for (const char* method : {"\"implicit_euler\"", "3", "3.0", "\"3\""}) {
    const Scene scene =
        ParseScene(EditedSceneText("Method\": 2", std::string("Method\": ") + method),
                   "scene.txt");
    EXPECT_EQ(scene.integration_method, IntegrationMethod::kImplicitEuler) << method;
  }
  const Scene scene =
      ParseScene(EditedSceneText("Iterations\": 10", "Iterations\": 100.0"), "s");
  EXPECT_EQ(scene.num_frames, 100);
}

TEST(SceneIo, UnknownKeysAreWarningsThatNameThem) {
  std::vector<std::string> warnings;
  ParseScene(EditedSceneText("\"damping\": 0.2",
                             "\"dampening\": 1, \"damping\": 0.2, "
                             "\"estimate\": {\"mass\": true}"),
             "scene.txt", &warnings);
  EXPECT_THAT(warnings,
              ElementsAre(AllOf(StartsWith("scene.txt: objects[0].dampening"),
                                HasSubstr("unknown key")),
                          StartsWith("scene.txt: objects[0].estimate.mass: ")));
}

TEST(SceneIo, ManyUnknownKeysDoNotFloodTheWarnings) {
  std::string many;
  for (int i = 0; i < 1000; ++i) many += "\"key" + std::to_string(i) + "\": 1, ";
  std::vector<std::string> warnings;
  ParseScene(EditedSceneText("\"title\"", many + "\"title\""), "scene.txt", &warnings);
  EXPECT_EQ(warnings.size(), 20);
  EXPECT_THAT(warnings.back(), HasSubstr("further ones are not listed"));
}

TEST(SceneIo, TextThatIsNotJsonIsLocated) {
  const std::string text = SmallSceneText();
  EXPECT_THAT(SceneErrorOf(text.substr(0, text.find("0.25"))),
              AllOf(StartsWith("scene.txt: objects[0].vertMass[1]: not JSON: line 14, "
                               "column 23"),
                    HasSubstr("unexpected end of input")));
  EXPECT_THAT(SceneErrorOf(EditedSceneText("0.25", "NaN")),
              AllOf(HasSubstr("objects[0].vertMass[1]"), HasSubstr("line 14, column"),
                    HasSubstr("invalid literal")));
  EXPECT_THAT(SceneErrorOf(EditedSceneText("0.25", "1e999")),
              AllOf(HasSubstr("objects[0].vertMass[1]: line 14, column"),
                    HasSubstr("1e999"), HasSubstr("expected a finite number")));
  EXPECT_THAT(SceneErrorOf(text + "}"), HasSubstr("expected end of input"));
  EXPECT_THAT(SceneErrorOf(""), HasSubstr("the file is empty"));
  EXPECT_THAT(SceneErrorOf(" \n\t"), HasSubstr("the file is empty"));
  EXPECT_THAT(SceneErrorOf(std::string("\x7f"
                                       "ELF\0\x01\xff\xfe",
                                       8)),
              AllOf(StartsWith("scene.txt: not JSON: line 1, column 1"),
                    ::testing::Not(HasSubstr("\xff"))));
  EXPECT_THAT(SceneErrorOf(std::string(1000000, '[')), HasSubstr("nested too deep"));
  EXPECT_THAT(
      SceneErrorOf(EditedSceneText("\"damping\"", "\"springs\": [], \"damping\"")),
      HasSubstr("objects[0].springs is given twice"));
}

TEST(SceneIo, MissingKeysAreNamed) {
  EXPECT_THAT(SceneErrorOf("{\"delta\": 1}"), HasSubstr("objects is missing"));
  for (const char* key :
       {"delta", "vertPos", "vertMass", "springStiffness", "type", "pos"}) {
    const std::string quoted = "\"" + std::string(key) + "\"";
    EXPECT_THAT(SceneErrorOf(EditedSceneText(quoted, "\"renamed\"")),
                AllOf(StartsWith("scene.txt: "),
                      HasSubstr(std::string(key) + " is missing; expected ")));
  }
}

struct WrongValue {
  const char* from;
  const char* to;
  const char* path;
  const char* value;
  const char* accepted;
};

TEST(SceneIo, WrongTypesAreNamedWithPathValueAndWhatIsAccepted) {
  const WrongValue kWrong[] = {
      {"\"small\"", "7", "title", "7", "text"},
      {"\"delta\": 0.02", "\"delta\": \"fast\"", "delta", "\"fast\"", "finite number"},
      {"Method\": 2", "Method\": 9", "integrationMethod", "\"9\"", "implicit_euler"},
      {"Method\": 2", "Method\": -1", "integrationMethod", "-1", "from 0"},
      {"Method\": 2", "Method\": \"rk4\"", "integrationMethod", "rk4",
       "explicit_euler"},
      {"Method\": 2", "Method\": []", "integrationMethod", "an array", "whole number"},
      {"Iterations\": 10", "Iterations\": 1.5", "optimizationIterations", "1.5",
       "whole"},
      {"Iterations\": 10", "Iterations\": 0", "optimizationIterations", "0", "from 1"},
      {"Iterations\": 10", "Iterations\": 2147483648", "optimizationIterations",
       "2147483648", "to 2147483647"},
      {"Iterations\": 10", "Iterations\": 99999999999999999999",
       "optimizationIterations", "1e+20", "to 2147483647"},
      {"SubSteps\": 3", "SubSteps\": -3", "forwardSubSteps", "-3", "from 1"},
      {"\"printTimes\": true", "\"printTimes\": 1", "printTimes", "1", "true or false"},
      {"\"y\": 0, \"z\": -2", "\"y\": 0", "windVel.z", "missing", "\"x\""},
      {"\"x\": 1.5", "\"x\": null", "windVel.x", "null", "finite number"},
      {"\"objects\": [{", "\"objects\": [3, {", "objects[0]", "3", "object"},
      {"\"title\": \"small\"", "\"gravity\": 9.81", "gravity", "9.81", "three"},
      {"\"title\": \"small\"", "\"aerodynamics\": \"none\"", "aerodynamics", "none",
       "\"authored\", \"unit_normal\""},
      {"\"title\": \"small\"", "\"solver\": \"lu\"", "solver", "lu", "cholesky"},
      {"\"title\": \"small\"", "\"estimate\": true", "estimate", "true", "object"},
      {"\"title\": \"small\"", "\"estimate\": {\"wind\": 1}", "estimate.wind", "1",
       "true or false"},
      {"[true, false, false]", "[true, 0, false]", "objects[0].vertIsFixed[1]", "0",
       "true or false"},
      {"0.25", "\"heavy\"", "objects[0].vertMass[1]", "\"heavy\"", "finite number"},
      {"[0, 1, 1, 2]", "[0, 1, 1]", "objects[0].springs", "array of 3", "pairs"},
      {"[0, 1, 1, 2]", "[0, 1, -1, 2]", "objects[0].springs[2]", "-1", "from 0"},
      {"[0, 1, 1, 2]", "{}", "objects[0].springs", "an object", "array"},
      {"\"nL\"", "\"nL\", \"springRestLength\": [1, \"long\"]",
       "objects[0].springRestLength[1]", "long", "finite number"},
      {"[0, 1, 2]", "[0, 1, 2, 0]", "objects[0].triangles", "array of 4", "triples"},
      {"\"nL\"", "\"nLx\"", "objects[0].optimizationSettings", "nLx", "two letters"},
      {"\"nL\"", "\"nQ\"", "objects[0].optimizationSettings", "Q", "R (one per group)"},
      {"\"nL\"", "\"nL\", \"springKind\": [\"bend\", \"twist\"]",
       "objects[0].springKind[1]", "twist", "\"stretch\", \"shear\", \"bend\""},
      {"\"type\": 1", "\"type\": 2", "colliders[0].type", "2",
       "0 (plane) or 1 (sphere)"},
  };
  for (const WrongValue& wrong : kWrong) {
    const std::string message = SceneErrorOf(EditedSceneText(wrong.from, wrong.to));
    EXPECT_THAT(message, AllOf(StartsWith(std::string("scene.txt: ") + wrong.path),
                               HasSubstr(wrong.value), HasSubstr(wrong.accepted)))
        << wrong.to;
  }
}

std::string LoadErrorOf(const std::string& path) {
  try {
    LoadScene(path);
  } catch (const SceneError& error) {
    return error.what();
  }
  return "";
}

TEST(SceneIo, FilesThatCannotBeScenesAreRefused) {
  const TempDir folder;
  EXPECT_THAT(LoadErrorOf(folder.File("absent")),
              AllOf(StartsWith(folder.File("absent")), HasSubstr("does not exist")));
  EXPECT_THAT(LoadErrorOf(folder.path()), HasSubstr("is a folder"));
  EXPECT_THAT(LoadErrorOf("/dev/zero"), HasSubstr("not a regular file"));
  EXPECT_THAT(LoadErrorOf(""), HasSubstr("does not exist"));
  WriteFile(folder.File("empty"), "");
  EXPECT_THAT(LoadErrorOf(folder.File("empty")), HasSubstr("the file is empty"));
}

TEST(SceneIo, AHugeFileIsRefusedBySizeWithoutReadingIt) {
  const TempDir folder;
  const std::string path = folder.File("huge");
  WriteFile(path, "{");
  std::filesystem::resize_file(path, std::uintmax_t{1} << 30);  // sparse
  EXPECT_THAT(LoadErrorOf(path), AllOf(HasSubstr("1073741824"), HasSubstr("256 MiB")));
}

TEST(SceneIo, LoadingTakesTimeInProportionToTheScene) {
  // The best of a few runs: other work on the machine only ever adds time.
  const auto seconds = [](int side) {
    const std::string text =
        SceneToJson(MakePresetScene(ScenePreset::kSide, {side, side, 7.0, {}}));
    double best = std::numeric_limits<double>::infinity();
    for (int run = 0; run < 3; ++run) {
      const auto start = std::chrono::steady_clock::now();
      const Scene scene = ParseScene(text, "large");
      const std::chrono::duration<double> elapsed =
          std::chrono::steady_clock::now() - start;
      EXPECT_EQ(scene.objects[0].num_vertices(), side * side);
      best = std::min(best, elapsed.count());
    }
    return best;
  };
  // Nine times the vertices: a check of every pair would take 81 times as long.
  EXPECT_LT(seconds(144), 27.0 * seconds(48));
}

TEST(SceneIo, AnInvalidSceneIsNotSaved) {
  const TempDir folder;
  const std::string path = folder.File("scene.txt");
  WriteFile(path, "old");
  Scene scene = MakePresetScene(ScenePreset::kSide, {3, 3, 1.0, {}});
  scene.objects[0].mass[0] = std::nan("");
  EXPECT_THROW(SaveScene(scene, path), SceneError);
  scene.objects[0].mass[0] = 1.0;
  scene.title = "\xff";
  EXPECT_THROW(SaveScene(scene, path), SceneError);
  EXPECT_EQ(ReadFile(path), "old");
}

}  // namespace
}  // namespace dpe::test
