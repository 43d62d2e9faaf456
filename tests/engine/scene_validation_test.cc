#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

#include "dpe/engine/scene_io.h"
#include "support/scene_text.h"

namespace dpe::test {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::StartsWith;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

struct Invalid {
  const char* what;
  std::function<void(Scene*)> spoil;
  const char* path;
  const char* value;
  const char* accepted;
};

ClothObject& Cloth(Scene* scene) { return scene->objects[0]; }

PrescribedPath Path(int vertex, int frames) {
  return {vertex, Eigen::Matrix3Xd::Zero(3, frames)};
}

// Each entry spoils one thing of a valid scene.
void ExpectRefused(const std::vector<Invalid>& cases) {
  const Scene valid = ParseScene(SmallSceneText(), "scene.txt");
  for (const Invalid& invalid : cases) {
    Scene scene = valid;
    invalid.spoil(&scene);
    std::string message;
    try {
      ValidateScene(scene, "scene.txt");
    } catch (const SceneError& error) {
      message = error.what();
    }
    EXPECT_THAT(message,
                AllOf(StartsWith(std::string("scene.txt: ") + invalid.path + ": "),
                      HasSubstr(invalid.value), HasSubstr("is not accepted; expected "),
                      HasSubstr(invalid.accepted)))
        << invalid.what;
  }
}

TEST(SceneValidation, RefusesWrongScalars) {
  ExpectRefused({
      {"delta zero", [](Scene* s) { s->delta = 0.0; }, "delta", "0.0", "> 0 s"},
      {"delta negative", [](Scene* s) { s->delta = -1.0; }, "delta", "-1.0", "> 0 s"},
      {"delta nan", [](Scene* s) { s->delta = kNan; }, "delta", "nan", "finite"},
      {"delta inf", [](Scene* s) { s->delta = kInfinity; }, "delta", "inf", "finite"},
      {"tolerance", [](Scene* s) { s->tolerance = 0.0; }, "tolerance", "0.0", "> 0"},
      {"frames", [](Scene* s) { s->num_frames = 0; }, "optimizationIterations", "0",
       ">= 1"},
      {"steps", [](Scene* s) { s->steps_per_frame = 0; }, "forwardSubSteps", "0",
       ">= 1"},
      {"wind", [](Scene* s) { s->wind.y() = kNan; }, "windVel.y", "nan", "finite"},
      {"gravity", [](Scene* s) { s->gravity.z() = -kInfinity; }, "gravity.z", "-inf",
       "finite"},
      {"solver", [](Scene* s) { s->solver = "lu"; }, "solver", "\"lu\"", "\"cg\""},
      {"no objects", [](Scene* s) { s->objects.clear(); }, "objects", "empty",
       "at least one cloth"},
      {"damping", [](Scene* s) { Cloth(s).damping = -0.5; }, "objects[0].damping",
       "-0.5", ">= 0"},
      {"drag", [](Scene* s) { Cloth(s).drag_coefficient = kNan; },
       "objects[0].dragCoefficient", "nan", "finite"},
  });
}

TEST(SceneValidation, RefusesWrongVertices) {
  ExpectRefused({
      {"no vertices", [](Scene* s) { Cloth(s).positions.resize(0); },
       "objects[0].vertPos", "0 coordinates", "at least one vertex"},
      {"all fixed",
       [](Scene* s) {
         Cloth(s).is_fixed = {1, 1, 1};
       },
       "objects[0].vertIsFixed", "true for every vertex", "at least one free vertex"},
      {"position", [](Scene* s) { Cloth(s).positions[4] = kNan; },
       "objects[0].vertPos[1].y", "nan", "finite"},
      {"velocity", [](Scene* s) { Cloth(s).velocities[8] = kInfinity; },
       "objects[0].vertVel[2].z", "inf", "finite"},
      {"mass zero", [](Scene* s) { Cloth(s).mass[1] = 0.0; }, "objects[0].vertMass[1]",
       "0.0", "> 0 kg (the vertex is free)"},
      {"mass negative", [](Scene* s) { Cloth(s).mass[2] = -2.0; },
       "objects[0].vertMass[2]", "-2.0", "> 0 kg"},
      {"mass nan", [](Scene* s) { Cloth(s).mass[2] = kNan; }, "objects[0].vertMass[2]",
       "nan", "finite"},
      {"negative mass of a fixed vertex", [](Scene* s) { Cloth(s).mass[0] = -1.0; },
       "objects[0].vertMass[0]", "-1.0", ">= 0 kg (the vertex is fixed)"},
  });
}

TEST(SceneValidation, RefusesWrongSpringsAndTriangles) {
  ExpectRefused({
      {"spring index",
       [](Scene* s) {
         Cloth(s).springs[1] = {1, 3};
       },
       "objects[0].springs[3]", "3", "0 to 2"},
      {"spring index negative",
       [](Scene* s) {
         Cloth(s).springs[1] = {-1, 2};
       },
       "objects[0].springs[2]", "-1", "0 to 2"},
      {"identical ends",
       [](Scene* s) {
         Cloth(s).springs[1] = {2, 2};
       },
       "objects[0].springs[2]", "the pair 2, 2", "two different vertices"},
      {"zero length", [](Scene* s) { Cloth(s).positions.segment<3>(3).setZero(); },
       "objects[0].springs[0]", "the pair 0, 1 of length 0.0 m", "1e-9 m"},
      {"stiffness negative", [](Scene* s) { Cloth(s).stiffness[1] = -1.0; },
       "objects[0].springStiffness[1]", "-1.0", ">= 0 N/m"},
      {"stiffness inf", [](Scene* s) { Cloth(s).stiffness[0] = kInfinity; },
       "objects[0].springStiffness[0]", "inf", "finite"},
      {"no length in vertPos, whatever the length at rest",
       [](Scene* s) {
         Cloth(s).rest_length = Eigen::Vector2d(1.0, 1.0);
         Cloth(s).positions.segment<3>(3).setZero();
       },
       "objects[0].springs[0]", "the pair 0, 1 of length 0.0 m", "1e-9 m"},
      {"rest length zero",
       [](Scene* s) { Cloth(s).rest_length = Eigen::Vector2d(1.0, 0.0); },
       "objects[0].springRestLength[1]", "0.0", "> 1e-9 m"},
      {"rest length negative",
       [](Scene* s) { Cloth(s).rest_length = Eigen::Vector2d(-1.0, 1.0); },
       "objects[0].springRestLength[0]", "-1.0", "> 1e-9 m"},
      {"rest length nan",
       [](Scene* s) { Cloth(s).rest_length = Eigen::Vector2d(1.0, kNan); },
       "objects[0].springRestLength[1]", "nan", "finite"},
      {"rest length inf",
       [](Scene* s) { Cloth(s).rest_length = Eigen::Vector2d(kInfinity, 1.0); },
       "objects[0].springRestLength[0]", "inf", "finite"},
      {"initial positions without rest lengths",
       [](Scene* s) { Cloth(s).estimate_initial_position = true; },
       "objects[0].estimate.initialPosition", "true", "springRestLength"},
      {"triangle index",
       [](Scene* s) {
         Cloth(s).triangles[0] = {0, 1, 7};
       },
       "objects[0].triangles[2]", "7", "0 to 2"},
      {"triangle with a repeated vertex",
       [](Scene* s) {
         Cloth(s).triangles[0] = {0, 1, 1};
       },
       "objects[0].triangles[0]", "0, 1, 1 of area 0.0 m^2", "not lie on a line"},
      {"triangle on a line",
       [](Scene* s) { Cloth(s).positions.segment<3>(6) << 3.0, 0.0, 0.0; },
       "objects[0].triangles[0]", "of area 0.0 m^2", "not lie on a line"},
  });
}

TEST(SceneValidation, RefusesLengthsThatDisagree) {
  ExpectRefused({
      {"fixed", [](Scene* s) { Cloth(s).is_fixed.pop_back(); },
       "objects[0].vertIsFixed", "2 entries", "3, one per vertex"},
      {"mass", [](Scene* s) { Cloth(s).mass = Eigen::VectorXd::Ones(4); },
       "objects[0].vertMass", "4 entries", "3, one per vertex"},
      {"velocity", [](Scene* s) { Cloth(s).velocities.resize(6); },
       "objects[0].vertVel", "2 entries", "3, one per vertex"},
      {"stiffness", [](Scene* s) { Cloth(s).stiffness = Eigen::VectorXd::Ones(1); },
       "objects[0].springStiffness", "1 entries", "2, one per pair"},
      {"rest length", [](Scene* s) { Cloth(s).rest_length = Eigen::VectorXd::Ones(3); },
       "objects[0].springRestLength", "3 entries", "2, one per pair"},
      {"spring group", [](Scene* s) { Cloth(s).spring_group = {1}; },
       "objects[0].springGroup", "1 entries", "2, one per pair"},
      {"spring kind", [](Scene* s) { Cloth(s).spring_kind = {SpringKind::kBend}; },
       "objects[0].springKind", "1 entries", "2, one per pair"},
      {"vertex group",
       [](Scene* s) {
         Cloth(s).vertex_group = {1, 2};
       },
       "objects[0].vertexGroup", "2 entries", "3, one per vertex"},
      {"group number",
       [](Scene* s) {
         Cloth(s).vertex_group = {1, -2, 0};
       },
       "objects[0].vertexGroup[1]", "-2", ">= 0"},
  });
}

TEST(SceneValidation, RefusesWrongPathsAndColliders) {
  ExpectRefused({
      {"path of a free vertex",
       [](Scene* s) { Cloth(s).prescribed_paths = {Path(1, 2)}; },
       "objects[0].prescribedPaths[0].vertex", "1", "a vertex that is fixed"},
      {"path of no vertex", [](Scene* s) { Cloth(s).prescribed_paths = {Path(3, 2)}; },
       "objects[0].prescribedPaths[0].vertex", "3", "0 to 2"},
      {"two paths",
       [](Scene* s) {
         Cloth(s).prescribed_paths = {Path(0, 2), Path(0, 2)};
       },
       "objects[0].prescribedPaths[1].vertex", "0", "one path per vertex"},
      {"empty path", [](Scene* s) { Cloth(s).prescribed_paths = {Path(0, 0)}; },
       "objects[0].prescribedPaths[0].positions", "empty", "at least one position"},
      {"path nan",
       [](Scene* s) {
         Cloth(s).prescribed_paths = {Path(0, 2)};
         Cloth(s).prescribed_paths[0].positions(0, 1) = kNan;
       },
       "objects[0].prescribedPaths[0].positions[1].x", "nan", "finite"},
      {"radius zero", [](Scene* s) { s->colliders[0].scale.x() = 0.0; },
       "colliders[0].scale.x", "0.0", "> 0 m"},
      {"radius negative", [](Scene* s) { s->colliders[0].scale.x() = -2.0; },
       "colliders[0].scale.x", "-2.0", "> 0 m"},
      {"collider position", [](Scene* s) { s->colliders[0].position.z() = kNan; },
       "colliders[0].pos.z", "nan", "finite"},
      {"collider rotation",
       [](Scene* s) { s->colliders[0].rotation_degrees.x() = kNan; },
       "colliders[0].rot.x", "nan", "finite"},
      {"collider stiffness", [](Scene* s) { s->colliders[0].stiffness = -1.0; },
       "colliders[0].stiffness", "-1.0", ">= 0 N/m"},
  });
}

std::vector<std::string> WarningsOf(const std::function<void(Scene*)>& change) {
  Scene scene = ParseScene(SmallSceneText(), "scene.txt");
  change(&scene);
  std::vector<std::string> warnings;
  ValidateScene(scene, "scene.txt", &warnings);
  return warnings;
}

TEST(SceneValidation, AcceptsWhatHasAMeaning) {
  EXPECT_THAT(WarningsOf([](Scene*) {}), IsEmpty());
  EXPECT_THAT(WarningsOf([](Scene* s) { Cloth(s).mass[0] = 0.0; }), IsEmpty());
  EXPECT_THAT(WarningsOf([](Scene* s) { Cloth(s).stiffness.setZero(); }), IsEmpty());
  EXPECT_THAT(WarningsOf([](Scene* s) { Cloth(s).prescribed_paths = {Path(0, 3)}; }),
              IsEmpty());
  // The scale of a plane has no meaning.
  EXPECT_THAT(WarningsOf([](Scene* s) {
                s->colliders[0].type = ColliderType::kPlane;
                s->colliders[0].scale.setZero();
              }),
              IsEmpty());
}

TEST(SceneValidation, WarnsOfWhatIsOftenASlip) {
  EXPECT_THAT(
      WarningsOf([](Scene* s) {
        Cloth(s).springs[1] = {1, 0};
      }),
      ElementsAre(AllOf(StartsWith("scene.txt: objects[0].springs[2]: 1 springs"),
                        HasSubstr("add up")),
                  HasSubstr("objects[0].vertPos[2]: 1 free vertices have no")));
  EXPECT_THAT(WarningsOf([](Scene* s) { Cloth(s).drag_coefficient = 0.0; }),
              ElementsAre(HasSubstr("windVel: no object feels it")));
  EXPECT_THAT(WarningsOf([](Scene* s) {
                Cloth(s).triangles.clear();
                Cloth(s).estimate_drag = s->estimate_wind = true;
              }),
              ElementsAre(HasSubstr("estimate.dragCoefficient: the object has no tri"),
                          HasSubstr("estimate.wind: no object feels it")));
  EXPECT_THAT(WarningsOf([](Scene* s) {
                Cloth(s).prescribed_paths = {Path(0, 2)};
                Cloth(s).prescribed_paths[0].positions(1, 0) = 0.5;
              }),
              ElementsAre(AllOf(HasSubstr("prescribedPaths[0].positions[0]"),
                                HasSubstr("0.5 m"))));
}

TEST(SceneValidation, WarningsAreOptional) {
  Scene scene = ParseScene(SmallSceneText(), "scene.txt");
  scene.objects[0].drag_coefficient = 0.0;
  EXPECT_NO_THROW(ValidateScene(scene, "scene.txt"));
}

}  // namespace
}  // namespace dpe::test
