// Scenes as text: keys in the order of the format's description, one per line; keys
// that were added to the legacy format only where they differ from their default.
#include <cmath>
#include <string>
#include <vector>

#include "dpe/engine/scene_io.h"
#include "io/enum_names.h"
#include "io/json_io.h"
#include "io/number_text.h"

namespace dpe {
namespace {

std::string Text(double value) { return NumberText(value); }
std::string Text(int value) { return std::to_string(value); }
std::string Text(bool value) { return value ? "true" : "false"; }
std::string Text(const std::string& value) {
  try {
    return Json(value).dump();
  } catch (const Json::exception&) {
    throw SceneError("scene: the text \"" + value +
                     "\" is not accepted; expected UTF-8");
  }
}
std::string Text(const Eigen::Vector3d& v) {
  return "{\"x\": " + Text(v.x()) + ", \"y\": " + Text(v.y()) +
         ", \"z\": " + Text(v.z()) + "}";
}

// [text(0), text(1), ...]
template <typename TextOf>
std::string Array(long size, TextOf text) {
  std::string result = "[";
  for (long i = 0; i < size; ++i) {
    if (i > 0) result += ", ";
    result += text(i);
  }
  return result + "]";
}

// The same with one element per line.
template <typename TextOf>
std::string Lines(long size, const std::string& indent, TextOf text) {
  std::string result = "[";
  for (long i = 0; i < size; ++i) {
    result += (i > 0 ? ",\n" : "\n") + indent + "  " + text(i);
  }
  return result + (size > 0 ? "\n" + indent : "") + "]";
}

template <typename Container>
std::string Array(const Container& values) {
  return Array(static_cast<long>(values.size()),
               [&](long i) { return Text(values[i]); });
}

template <size_t N>
std::string FlatArray(const std::vector<std::array<int, N>>& tuples) {
  return Array(static_cast<long>(N * tuples.size()),
               [&](long i) { return Text(tuples[i / N][i % N]); });
}

// 3n numbers as vectors.
std::string VectorArray(const Eigen::Ref<const Eigen::VectorXd>& flat) {
  return Array(flat.size() / 3,
               [&](long i) { return Text(Eigen::Vector3d(flat.segment<3>(3 * i))); });
}

// The members of an object, one per line.
class Members {
 public:
  explicit Members(int depth) : indent_(2 * depth, ' ') {}

  void Add(const std::string& key, const std::string& value) {
    text_ += (text_.empty() ? "{\n" : ",\n") + indent_ + "\"" + key + "\": " + value;
  }

  std::string Close() const {
    return text_.empty() ? "{}" : text_ + "\n" + indent_.substr(2) + "}";
  }

 private:
  std::string indent_;
  std::string text_;
};

bool IsPlusZero(const Eigen::VectorXd& values) {
  for (double value : values) {
    if (value != 0.0 || std::signbit(value)) return false;
  }
  return true;
}

std::string FlagsText(std::initializer_list<std::pair<const char*, bool>> flags) {
  std::string text;
  for (const auto& [key, is_set] : flags) {
    if (is_set) text += (text.empty() ? "" : ", ") + Text(std::string(key)) + ": true";
  }
  return text.empty() ? "" : "{" + text + "}";
}

std::string PathText(const PrescribedPath& path) {
  return "{\"vertex\": " + Text(path.vertex) +
         ", \"positions\": " + VectorArray(path.positions.reshaped()) + "}";
}

void AddOptional(const ClothObject& object, Members* members) {
  if (object.rest_length.size() > 0) {
    members->Add("springRestLength", Array(object.rest_length));
  }
  if (!object.spring_group.empty()) {
    members->Add("springGroup", Array(object.spring_group));
  }
  if (!object.vertex_group.empty()) {
    members->Add("vertexGroup", Array(object.vertex_group));
  }
  if (!object.spring_kind.empty()) {
    members->Add(
        "springKind", Array(object.spring_kind.size(), [&](long i) {
          return Text(std::string(NameOf(kSpringKindNames, object.spring_kind[i])));
        }));
  }
  const std::string estimate =
      FlagsText({{"damping", object.estimate_damping},
                 {"dragCoefficient", object.estimate_drag},
                 {"initialVelocity", object.estimate_initial_velocity},
                 {"initialPosition", object.estimate_initial_position}});
  if (!estimate.empty()) members->Add("estimate", estimate);
  if (!IsPlusZero(object.velocities)) {
    members->Add("vertVel", VectorArray(object.velocities));
  }
  if (!object.prescribed_paths.empty()) {
    members->Add("prescribedPaths", Array(object.prescribed_paths.size(), [&](long i) {
                   return PathText(object.prescribed_paths[i]);
                 }));
  }
}

std::string ObjectText(const ClothObject& object) {
  Members members(3);
  members.Add("vertPos", VectorArray(object.positions));
  members.Add("vertIsFixed", Array(object.is_fixed.size(), [&](long i) {
                return Text(object.is_fixed[i] != 0);
              }));
  members.Add("vertMass", Array(object.mass));
  members.Add("springs", FlatArray(object.springs));
  members.Add("springStiffness", Array(object.stiffness));
  members.Add("triangles", FlatArray(object.triangles));
  members.Add("dragCoefficient", Text(object.drag_coefficient));
  members.Add("damping", Text(object.damping));
  members.Add("optimizationSettings",
              Text(std::string{ParameterModeLetter(object.mass_mode),
                               ParameterModeLetter(object.stiffness_mode)}));
  AddOptional(object, &members);
  return members.Close();
}

std::string ColliderText(const Collider& collider) {
  Members members(3);
  members.Add("type", Text(static_cast<int>(collider.type)));
  members.Add("pos", Text(collider.position));
  members.Add("rot", Text(collider.rotation_degrees));
  members.Add("scale", Text(collider.scale));
  if (collider.stiffness != Collider().stiffness) {
    members.Add("stiffness", Text(collider.stiffness));
  }
  return members.Close();
}

}  // namespace

std::string SceneToJson(const Scene& scene) {
  const Scene defaults;
  Members members(1);
  members.Add("title", Text(scene.title));
  members.Add("delta", Text(scene.delta));
  members.Add("integrationMethod", Text(static_cast<int>(scene.integration_method)));
  members.Add("tolerance", Text(scene.tolerance));
  members.Add("optimizationIterations", Text(scene.num_frames));
  members.Add("forwardSubSteps", Text(scene.steps_per_frame));
  members.Add("printTimes", Text(scene.print_times));
  members.Add("windVel", Text(scene.wind));
  if (scene.gravity != defaults.gravity) members.Add("gravity", Text(scene.gravity));
  if (scene.aerodynamics != defaults.aerodynamics) {
    members.Add("aerodynamics",
                Text(std::string(NameOf(kAerodynamicsNames, scene.aerodynamics))));
  }
  if (scene.solver != defaults.solver) members.Add("solver", Text(scene.solver));
  if (scene.estimate_wind) members.Add("estimate", FlagsText({{"wind", true}}));
  members.Add("objects", Lines(scene.objects.size(), "  ",
                               [&](long i) { return ObjectText(scene.objects[i]); }));
  members.Add("colliders", Lines(scene.colliders.size(), "  ", [&](long i) {
                return ColliderText(scene.colliders[i]);
              }));
  return members.Close() + "\n";
}

}  // namespace dpe
