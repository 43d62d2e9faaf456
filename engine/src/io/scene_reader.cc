// Which keys a file has to have:
//   scene     delta, because observations are taken at that interval and a guess would
//             silently scale everything estimated from them; objects
//   object    vertPos, vertMass; springStiffness if it has springs
//   collider  type, pos
//   vector    x, y, z
// Everything else has a default: that of the fields in scene.h, "nn" for
// optimizationSettings, all vertices free for vertIsFixed. springRestLength (m, one per
// spring) is for cloths whose vertPos is not at rest; without it, the springs are at
// rest there.
#include "io/scene_reader.h"

#include <string>

#include "io/enum_names.h"

namespace dpe {
namespace {

void ReadIfGiven(const JsonNode& parent, const char* key, double* value) {
  if (const auto node = parent.Find(key)) *value = node->AsNumber();
}
void ReadIfGiven(const JsonNode& parent, const char* key, bool* value) {
  if (const auto node = parent.Find(key)) *value = node->AsBool();
}
void ReadIfGiven(const JsonNode& parent, const char* key, std::string* value) {
  if (const auto node = parent.Find(key)) *value = node->AsString();
}
void ReadIfGiven(const JsonNode& parent, const char* key, Eigen::Vector3d* value) {
  if (const auto node = parent.Find(key)) *value = node->AsVector();
}
void ReadIfGiven(const JsonNode& parent, const char* key, int* value) {
  if (const auto node = parent.Find(key)) *value = node->AsInt(1);
}

template <typename Enum, size_t N>
Enum AsEnum(const JsonNode& node, const EnumName<Enum> (&names)[N]) {
  const std::string text = node.IsString() ? node.AsString() : "";
  std::string accepted;
  for (const EnumName<Enum>& entry : names) {
    if (text == entry.name) return entry.value;
    accepted += std::string(accepted.empty() ? "\"" : ", \"") + entry.name + "\"";
  }
  node.Fail("one of " + accepted);
}

// Runs `convert`, whose SceneError knows the value but not where it stands.
template <typename Convert>
auto AtNode(const JsonNode& node, const JsonContext& context, Convert convert) {
  try {
    return convert();
  } catch (const SceneError& error) {
    throw SceneError(context.file + ": " + node.path() + ": " + error.what());
  }
}

class SceneReader {
 public:
  explicit SceneReader(const JsonNode& root) : root_(root) {}

  Scene Read() {
    Scene scene;
    ReadScalars(&scene);
    for (const JsonNode& node :
         root_.Require("objects", "an array of cloths").Elements()) {
      scene.objects.push_back(ReadObject(node));
    }
    if (const auto colliders = root_.Find("colliders")) {
      for (const JsonNode& node : colliders->Elements()) {
        scene.colliders.push_back(ReadCollider(node));
      }
    }
    return scene;
  }

 private:
  void ReadScalars(Scene* scene) {
    root_.WarnOfUnknownKeys({"title", "delta", "integrationMethod", "tolerance",
                             "optimizationIterations", "forwardSubSteps", "printTimes",
                             "windVel", "gravity", "aerodynamics", "solver", "estimate",
                             "objects", "colliders"});
    ReadIfGiven(root_, "title", &scene->title);
    scene->delta =
        root_.Require("delta", "the length of a frame in seconds").AsNumber();
    if (const auto node = root_.Find("integrationMethod")) {
      const std::string name =
          node->IsString() ? node->AsString() : std::to_string(node->AsInt(0));
      scene->integration_method = AtNode(
          *node, root_.context(), [&] { return IntegrationMethodFromName(name); });
    }
    ReadIfGiven(root_, "tolerance", &scene->tolerance);
    ReadIfGiven(root_, "optimizationIterations", &scene->num_frames);
    ReadIfGiven(root_, "forwardSubSteps", &scene->steps_per_frame);
    ReadIfGiven(root_, "printTimes", &scene->print_times);
    ReadIfGiven(root_, "windVel", &scene->wind);
    ReadIfGiven(root_, "gravity", &scene->gravity);
    if (const auto node = root_.Find("aerodynamics")) {
      scene->aerodynamics = AsEnum(*node, kAerodynamicsNames);
    }
    ReadIfGiven(root_, "solver", &scene->solver);
    if (const auto estimate = root_.Find("estimate")) {
      ReadIfGiven(*estimate, "wind", &scene->estimate_wind);
      estimate->WarnOfUnknownKeys({"wind"});
    }
  }

  ClothObject ReadObject(const JsonNode& node) {
    node.WarnOfUnknownKeys({"vertPos", "vertIsFixed", "vertMass", "springs",
                            "springStiffness", "triangles", "dragCoefficient",
                            "damping", "optimizationSettings", "springGroup",
                            "vertexGroup", "springKind", "springRestLength", "estimate",
                            "vertVel", "prescribedPaths"});
    ClothObject object;
    ReadVertices(node, &object);
    ReadSprings(node, &object);
    if (const auto triangles = node.Find("triangles")) {
      object.triangles = Tuples<3>(*triangles);
    }
    ReadIfGiven(node, "dragCoefficient", &object.drag_coefficient);
    ReadIfGiven(node, "damping", &object.damping);
    ReadPaths(node, &object);
    ReadEstimate(node, &object);
    return object;
  }

  void ReadVertices(const JsonNode& node, ClothObject* object) {
    const Eigen::Matrix3Xd positions =
        node.Require("vertPos", "the positions of the vertices in metres").AsVectors();
    object->positions = positions.reshaped();
    object->mass =
        node.Require("vertMass", "the masses of the vertices in kg").AsNumbers();
    object->is_fixed.assign(positions.cols(), 0);
    if (const auto fixed = node.Find("vertIsFixed")) {
      object->is_fixed = fixed->AsBools();
    }
    object->velocities = Eigen::VectorXd::Zero(positions.size());
    if (const auto velocities = node.Find("vertVel")) {
      object->velocities = velocities->AsVectors().reshaped();
    }
    if (const auto group = node.Find("vertexGroup")) {
      object->vertex_group = group->AsInts(0);
    }
  }

  void ReadSprings(const JsonNode& node, ClothObject* object) {
    if (const auto springs = node.Find("springs")) {
      object->springs = Tuples<2>(*springs);
    }
    if (!object->springs.empty()) {
      node.Require("springStiffness", "the stiffness of each spring in N/m");
    }
    if (const auto stiffness = node.Find("springStiffness")) {
      object->stiffness = stiffness->AsNumbers();
    }
    if (const auto rest_length = node.Find("springRestLength")) {
      object->rest_length = rest_length->AsNumbers();
    }
    if (const auto group = node.Find("springGroup")) {
      object->spring_group = group->AsInts(0);
    }
    if (const auto kinds = node.Find("springKind")) {
      for (const JsonNode& kind : kinds->Elements()) {
        object->spring_kind.push_back(AsEnum(kind, kSpringKindNames));
      }
    }
  }

  // Vertex indices, N after N in a flat array.
  template <size_t N>
  std::vector<std::array<int, N>> Tuples(const JsonNode& node) {
    const std::vector<int> flat = node.AsInts(0);
    if (flat.size() % N != 0) {
      node.Fail("a flat array of " + std::string(N == 2 ? "pairs" : "triples") +
                " of vertex indices");
    }
    std::vector<std::array<int, N>> tuples(flat.size() / N);
    for (size_t i = 0; i < flat.size(); ++i) tuples[i / N][i % N] = flat[i];
    return tuples;
  }

  void ReadPaths(const JsonNode& node, ClothObject* object) {
    const auto paths = node.Find("prescribedPaths");
    if (!paths) return;
    for (const JsonNode& path_node : paths->Elements()) {
      PrescribedPath path;
      path.vertex = path_node.Require("vertex", "the index of a fixed vertex").AsInt(0);
      path.positions =
          path_node.Require("positions", "a position per frame in metres").AsVectors();
      path_node.WarnOfUnknownKeys({"vertex", "positions"});
      object->prescribed_paths.push_back(std::move(path));
    }
  }

  void ReadEstimate(const JsonNode& node, ClothObject* object) {
    if (const auto settings = node.Find("optimizationSettings")) {
      const std::string letters = settings->AsString();
      if (letters.size() != 2) {
        settings->Fail("two letters, mass then stiffness, of n, G, L, R");
      }
      AtNode(*settings, root_.context(), [&] {
        object->mass_mode = ParameterModeFromLetter(letters[0]);
        object->stiffness_mode = ParameterModeFromLetter(letters[1]);
      });
    }
    if (const auto estimate = node.Find("estimate")) {
      ReadIfGiven(*estimate, "damping", &object->estimate_damping);
      ReadIfGiven(*estimate, "dragCoefficient", &object->estimate_drag);
      ReadIfGiven(*estimate, "initialVelocity", &object->estimate_initial_velocity);
      ReadIfGiven(*estimate, "initialPosition", &object->estimate_initial_position);
      estimate->WarnOfUnknownKeys(
          {"damping", "dragCoefficient", "initialVelocity", "initialPosition"});
    }
  }

  Collider ReadCollider(const JsonNode& node) {
    node.WarnOfUnknownKeys({"type", "pos", "rot", "scale", "stiffness"});
    Collider collider;
    const JsonNode type = node.Require("type", "0 (plane) or 1 (sphere)");
    const int number = type.AsInt(0);
    if (number > 1) type.Fail("0 (plane) or 1 (sphere)");
    collider.type = static_cast<ColliderType>(number);
    collider.position = node.Require("pos", "a position in metres").AsVector();
    ReadIfGiven(node, "rot", &collider.rotation_degrees);
    ReadIfGiven(node, "scale", &collider.scale);
    ReadIfGiven(node, "stiffness", &collider.stiffness);
    return collider;
  }

  const JsonNode& root_;
};

}  // namespace

Scene ReadScene(const JsonNode& root) { return SceneReader(root).Read(); }

}  // namespace dpe
