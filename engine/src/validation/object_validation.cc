#include "validation/object_validation.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "io/number_text.h"

namespace dpe {
namespace {

// Below this a spring has no direction that rounding has not made up, m.
constexpr double kMinSpringLength = 1e-9;
// Area over the square of the longest edge below which a triangle is a line.
constexpr double kMinRelativeArea = 1e-12;

std::string At(const std::string& path, long index) {
  return path + "[" + std::to_string(index) + "]";
}

class ObjectChecker {
 public:
  ObjectChecker(const ClothObject& object, const std::string& path,
                const ValidationReport& report)
      : object_(object), path_(path), report_(report) {}

  void Check() const {
    CheckSizes();
    CheckVertices();
    CheckIndices("springs", object_.springs);
    CheckSprings();
    CheckIndices("triangles", object_.triangles);
    CheckTriangles();
    CheckScalars();
    CheckInitialPosition();
    CheckPaths();
    WarnOfDuplicateSprings();
    WarnOfLooseVertices();
  }

 private:
  long num_vertices() const { return object_.positions.size() / 3; }

  Eigen::Vector3d Point(int v) const { return object_.positions.segment<3>(3 * v); }

  std::string Path(const char* key) const { return path_ + "." + key; }

  void CheckSizes() const {
    const long n = num_vertices();
    const long num_springs = static_cast<long>(object_.springs.size());
    if (n == 0 || object_.positions.size() % 3 != 0) {
      report_.Fail(Path("vertPos"),
                   std::to_string(object_.positions.size()) + " coordinates",
                   "at least one vertex, three coordinates each");
    }
    const char* per_vertex = "one per vertex of vertPos";
    const char* per_spring = "one per pair of springs";
    report_.RequireSize(Path("vertIsFixed"), object_.is_fixed.size(), n, per_vertex);
    report_.RequireSize(Path("vertMass"), object_.mass.size(), n, per_vertex);
    if (object_.velocities.size() != 3 * n) {
      report_.RequireSize(Path("vertVel"), object_.velocities.size() / 3, n,
                          per_vertex);
      report_.RequireSize(Path("vertVel"), object_.velocities.size(), 3 * n,
                          "three coordinates per vertex");
    }
    report_.RequireSize(Path("springStiffness"), object_.stiffness.size(), num_springs,
                        per_spring);
    if (object_.rest_length.size() > 0) {
      report_.RequireSize(Path("springRestLength"), object_.rest_length.size(),
                          num_springs, per_spring);
    }
    if (!object_.vertex_group.empty()) {
      report_.RequireSize(Path("vertexGroup"), object_.vertex_group.size(), n,
                          per_vertex);
    }
    if (!object_.spring_group.empty()) {
      report_.RequireSize(Path("springGroup"), object_.spring_group.size(), num_springs,
                          per_spring);
    }
    if (!object_.spring_kind.empty()) {
      report_.RequireSize(Path("springKind"), object_.spring_kind.size(), num_springs,
                          per_spring);
    }
  }

  void CheckVertices() const {
    bool any_free = false;
    for (int v = 0; v < num_vertices(); ++v) {
      if (!Point(v).allFinite())
        report_.RequireFinite(At(Path("vertPos"), v), Point(v));
      const Eigen::Vector3d velocity = object_.velocities.segment<3>(3 * v);
      if (!velocity.allFinite()) {
        report_.RequireFinite(At(Path("vertVel"), v), velocity);
      }
      CheckMass(v);
      any_free |= !object_.is_fixed[v];
    }
    if (!any_free) {
      report_.Fail(Path("vertIsFixed"), "true for every vertex",
                   "at least one free vertex, so that there is something to simulate");
    }
  }

  // The mass of a fixed vertex has no influence; files set it to zero or leave it.
  void CheckMass(int v) const {
    const double mass = object_.mass[v];
    if (std::isfinite(mass) && (mass > 0.0 || (mass == 0.0 && object_.is_fixed[v]))) {
      return;
    }
    report_.Fail(At(Path("vertMass"), v), NumberText(mass),
                 object_.is_fixed[v] ? "a finite mass >= 0 kg (the vertex is fixed)"
                                     : "a finite mass > 0 kg (the vertex is free)");
  }

  template <size_t N>
  void CheckIndices(const char* key,
                    const std::vector<std::array<int, N>>& tuples) const {
    for (size_t t = 0; t < tuples.size(); ++t) {
      for (size_t i = 0; i < N; ++i) {
        const int v = tuples[t][i];
        if (v >= 0 && v < num_vertices()) continue;
        report_.Fail(
            At(Path(key), N * t + i), std::to_string(v),
            "the index of a vertex, 0 to " + std::to_string(num_vertices() - 1));
      }
    }
  }

  void CheckSprings() const {
    for (size_t s = 0; s < object_.springs.size(); ++s) {
      const auto [a, b] = object_.springs[s];
      const std::string pair =
          "the pair " + std::to_string(a) + ", " + std::to_string(b);
      if (a == b) {
        report_.Fail(At(Path("springs"), 2 * s), pair, "two different vertices");
      }
      const double length = (Point(a) - Point(b)).norm();
      if (!(length > kMinSpringLength) || !std::isfinite(length)) {
        report_.Fail(
            At(Path("springs"), 2 * s),
            pair + " of length " + NumberText(length) + " m",
            "a finite length > 1e-9 m: vertices at different places in vertPos");
      }
      const double stiffness = object_.stiffness[s];
      if (!std::isfinite(stiffness) || stiffness < 0.0) {
        report_.Fail(At(Path("springStiffness"), s), NumberText(stiffness),
                     "a finite stiffness >= 0 N/m");
      }
    }
    for (long s = 0; s < object_.rest_length.size(); ++s) {
      const double length = object_.rest_length[s];
      if (length > kMinSpringLength && std::isfinite(length)) continue;
      report_.Fail(At(Path("springRestLength"), s), NumberText(length),
                   "a finite length > 1e-9 m");
    }
    CheckGroups("springGroup", object_.spring_group);
    CheckGroups("vertexGroup", object_.vertex_group);
  }

  void CheckGroups(const char* key, const std::vector<int>& groups) const {
    for (size_t i = 0; i < groups.size(); ++i) {
      if (groups[i] >= 0) continue;
      report_.Fail(At(Path(key), i), std::to_string(groups[i]), "a group number >= 0");
    }
  }

  void CheckTriangles() const {
    for (size_t t = 0; t < object_.triangles.size(); ++t) {
      const auto [a, b, c] = object_.triangles[t];
      const Eigen::Vector3d ab = Point(b) - Point(a), ac = Point(c) - Point(a);
      const double area = ab.cross(ac).norm() / 2.0;
      const double scale =
          std::max({ab.squaredNorm(), ac.squaredNorm(), (ac - ab).squaredNorm()});
      if (area > kMinRelativeArea * scale && std::isfinite(area)) continue;
      report_.Fail(At(Path("triangles"), 3 * t),
                   "the triangle " + std::to_string(a) + ", " + std::to_string(b) +
                       ", " + std::to_string(c) + " of area " + NumberText(area) +
                       " m^2",
                   "three vertices that do not lie on a line");
    }
  }

  void CheckScalars() const {
    report_.RequireNotNegative(Path("damping"), object_.damping,
                               "a finite number >= 0 (1/s)");
    report_.RequireNotNegative(Path("dragCoefficient"), object_.drag_coefficient,
                               "a finite number >= 0");
  }

  // Else the springs' rest lengths would change with what is estimated.
  void CheckInitialPosition() const {
    if (!object_.estimate_initial_position || object_.springs.empty() ||
        object_.rest_length.size() > 0) {
      return;
    }
    report_.Fail(
        Path("estimate.initialPosition"), "true",
        "springRestLength beside it: vertPos cannot be estimated and say where "
        "springs are at rest");
  }

  void CheckPaths() const {
    std::vector<char> has_path(num_vertices(), 0);
    for (size_t p = 0; p < object_.prescribed_paths.size(); ++p) {
      const PrescribedPath& path = object_.prescribed_paths[p];
      const std::string where = At(Path("prescribedPaths"), p);
      const std::string vertex = std::to_string(path.vertex);
      if (path.vertex < 0 || path.vertex >= num_vertices()) {
        report_.Fail(
            where + ".vertex", vertex,
            "the index of a vertex, 0 to " + std::to_string(num_vertices() - 1));
      }
      if (!object_.is_fixed[path.vertex]) {
        report_.Fail(where + ".vertex", vertex,
                     "a vertex that is fixed: a free one moves by itself");
      }
      if (has_path[path.vertex]++) {
        report_.Fail(where + ".vertex", vertex, "one path per vertex, and it has one");
      }
      if (path.positions.cols() == 0) {
        report_.Fail(where + ".positions", "an empty array", "at least one position");
      }
      for (long f = 0; f < path.positions.cols(); ++f) {
        const Eigen::Vector3d position = path.positions.col(f);
        if (position.allFinite()) continue;
        report_.RequireFinite(At(where + ".positions", f), position);
      }
    }
  }

  // Accepted: two springs between the same vertices act as one whose stiffness is the
  // sum. Estimating both of them locally cannot tell them apart, though.
  void WarnOfDuplicateSprings() const {
    std::vector<int> order(object_.springs.size());
    std::iota(order.begin(), order.end(), 0);
    const auto key = [&](int s) {
      const auto [a, b] = object_.springs[s];
      return std::make_pair(std::min(a, b), std::max(a, b));
    };
    std::sort(order.begin(), order.end(), [&](int s, int t) {
      return std::make_pair(key(s), s) < std::make_pair(key(t), t);
    });
    int count = 0, first = -1;
    for (size_t i = 1; i < order.size(); ++i) {
      if (key(order[i]) != key(order[i - 1])) continue;
      if (count++ == 0) first = order[i];
    }
    if (count == 0) return;
    const auto [a, b] = object_.springs[first];
    report_.Warn(At(Path("springs"), 2 * first),
                 std::to_string(count) +
                     " springs join vertices that another one joins " +
                     "already, the first of them " + std::to_string(a) + ", " +
                     std::to_string(b) + "; their stiffnesses add up");
  }

  // Accepted: a vertex without springs falls by itself. Often a sign of a mesh whose
  // vertices were not merged.
  void WarnOfLooseVertices() const {
    std::vector<char> has_spring(num_vertices(), 0);
    for (const std::array<int, 2>& spring : object_.springs) {
      has_spring[spring[0]] = has_spring[spring[1]] = 1;
    }
    int count = 0, first = -1;
    for (int v = 0; v < num_vertices(); ++v) {
      if (has_spring[v] || object_.is_fixed[v]) continue;
      if (count++ == 0) first = v;
    }
    if (count == 0) return;
    report_.Warn(At(Path("vertPos"), first),
                 std::to_string(count) +
                     " free vertices have no spring, the first of " + "them " +
                     std::to_string(first));
  }

  const ClothObject& object_;
  const std::string& path_;
  const ValidationReport& report_;
};

}  // namespace

void ValidateObject(const ClothObject& object, const std::string& path,
                    const ValidationReport& report) {
  ObjectChecker(object, path, report).Check();
}

}  // namespace dpe
