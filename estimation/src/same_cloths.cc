#include <array>
#include <cmath>
#include <sstream>
#include <string>
#include <utility>

#include "dpe/estimation/joint_layout.h"

namespace dpe {
namespace {

// Relative. Rest lengths may come from files of few digits; masses and the like are
// given by hand.
constexpr double kSameLength = 1e-6;
constexpr double kSameValue = 1e-9;

bool Differ(double a, double b, double tolerance) {
  return std::abs(a - b) > tolerance * std::max(std::abs(a), std::abs(b));
}

class ClothComparison {
 public:
  ClothComparison(const Scene& first, const Scene& other, std::string first_name,
                  std::string other_name)
      : first_(first),
        other_(other),
        first_name_(std::move(first_name)),
        other_name_(std::move(other_name)) {}

  void Check() {
    Require("objects", first_.objects.size(), other_.objects.size());
    for (size_t o = 0; o < first_.objects.size(); ++o) {
      object_ = static_cast<int>(o);
      const ClothObject& a = first_.objects[o];
      const ClothObject& b = other_.objects[o];
      CheckTopology(a, b);
      CheckModes(a, b);
      CheckValues(a, b);
    }
  }

 private:
  [[noreturn]] void Fail(const std::string& what, const std::string& first,
                         const std::string& other, const std::string& hint = "") {
    std::ostringstream message;
    message << first_name_ << " and " << other_name_ << " are not of the same cloths: "
            << (object_ < 0 ? "" : "objects[" + std::to_string(object_) + "].") << what
            << " is " << first << " in " << first_name_ << " and " << other << " in "
            << other_name_ << "; accepted are equal ones" << hint;
    throw SceneError(message.str());
  }

  void Require(const std::string& what, size_t first, size_t other) {
    if (first != other) Fail(what, std::to_string(first), std::to_string(other));
  }

  void RequireNear(const std::string& what, double first, double other,
                   double tolerance, const std::string& hint = "") {
    if (!Differ(first, other, tolerance)) return;
    std::ostringstream a, b;
    a.precision(10);
    b.precision(10);
    a << first;
    b << other;
    Fail(what, a.str(), b.str(), hint);
  }

  // Lists of as many vertices (or groups) each.
  template <typename List>
  void RequireSameLists(const std::string& what, const List& first, const List& other) {
    for (size_t i = 0; i < first.size(); ++i) {
      if (first[i] == other[i]) continue;
      Fail(what + "[" + std::to_string(i) + "]", Text(first[i]), Text(other[i]));
    }
  }

  static std::string Text(int number) { return std::to_string(number); }

  template <size_t kSize>
  static std::string Text(const std::array<int, kSize>& numbers) {
    std::string text;
    for (const int number : numbers) {
      text += (text.empty() ? "" : "-") + std::to_string(number);
    }
    return text;
  }

  void CheckTopology(const ClothObject& a, const ClothObject& b) {
    Require("vertPos: the number of vertices", a.num_vertices(), b.num_vertices());
    Require("springs: their number", a.springs.size(), b.springs.size());
    Require("triangles: their number", a.triangles.size(), b.triangles.size());
    RequireSameLists("springs", a.springs, b.springs);
    RequireSameLists("triangles", a.triangles, b.triangles);
  }

  void CheckModes(const ClothObject& a, const ClothObject& b) {
    const auto letters = [](const ClothObject& object) {
      return std::string{ParameterModeLetter(object.mass_mode),
                         ParameterModeLetter(object.stiffness_mode)};
    };
    if (letters(a) != letters(b)) Fail("optimizationSettings", letters(a), letters(b));
    const auto flag = [](bool value) { return std::string(value ? "true" : "false"); };
    if (a.estimate_damping != b.estimate_damping) {
      Fail("estimate.damping", flag(a.estimate_damping), flag(b.estimate_damping));
    }
    if (a.estimate_drag != b.estimate_drag) {
      Fail("estimate.dragCoefficient", flag(a.estimate_drag), flag(b.estimate_drag));
    }
    if (a.stiffness_mode == ParameterMode::kGroup) {
      RequireSameLists("springGroup", SpringGroups(a), SpringGroups(b));
    }
    if (a.mass_mode == ParameterMode::kGroup) {
      RequireSameLists("vertexGroup", VertexGroups(a), VertexGroups(b));
    }
  }

  void CheckValues(const ClothObject& a, const ClothObject& b) {
    const Eigen::VectorXd lengths = RestLengths(a), other_lengths = RestLengths(b);
    for (int s = 0; s < a.num_springs(); ++s) {
      const std::string place = "[" + std::to_string(s) + "]";
      RequireNear("springRestLength" + place, lengths[s], other_lengths[s], kSameLength,
                  " (without springRestLength a scene's springs are at rest in its "
                  "vertPos)");
      if (a.stiffness_mode != ParameterMode::kFixed) continue;
      RequireNear("springStiffness" + place, a.stiffness[s], b.stiffness[s],
                  kSameValue);
    }
    for (int v = 0; v < a.num_vertices(); ++v) {
      // The mass of a fixed vertex says nothing.
      if (a.mass_mode != ParameterMode::kFixed || a.is_fixed[v] || b.is_fixed[v]) {
        continue;
      }
      RequireNear("vertMass[" + std::to_string(v) + "]", a.mass[v], b.mass[v],
                  kSameValue);
    }
    if (!a.estimate_damping) {
      RequireNear("damping", a.damping, b.damping, kSameValue);
    }
    if (!a.estimate_drag) {
      RequireNear("dragCoefficient", a.drag_coefficient, b.drag_coefficient,
                  kSameValue);
    }
    const bool has_drag = a.drag_coefficient != 0.0 || a.estimate_drag;
    if (has_drag && first_.aerodynamics != other_.aerodynamics) {
      object_ = -1;
      Fail("aerodynamics", AerodynamicsLawName(first_.aerodynamics),
           AerodynamicsLawName(other_.aerodynamics),
           " (the drag coefficient means different things in the two)");
    }
  }

  const Scene& first_;
  const Scene& other_;
  const std::string first_name_, other_name_;
  int object_ = -1;
};

}  // namespace

void RequireSameCloths(const std::vector<const Scene*>& scenes,
                       const std::vector<std::string>& names) {
  const auto name = [&](size_t s) {
    return s < names.size() ? names[s] : "scene " + std::to_string(s);
  };
  for (size_t s = 1; s < scenes.size(); ++s) {
    ClothComparison(*scenes[0], *scenes[s], name(0), name(s)).Check();
  }
}

}  // namespace dpe
