// Writes the motion of a cloth by another simulator than dpe's, as a folder of OBJ
// files: a continuum cut into finite elements, with forces that no spring of ours has.
// It is what a recording from elsewhere looks like, made where everything about it is
// known:
//
//   fem_cloth --output frames
//   estimate_cloth --target frames --rest_shape uv --target_rate 30 ...
//
// Membrane, constant strain triangles of the St. Venant-Kirchhoff material in plane
// stress. With D the edges (u1 - u0, u2 - u0) of a triangle at rest (its texture
// coordinates), A its area, and F = (x1 - x0, x2 - x0) D^{-1}:
//
//   E = (F^T F - I) / 2,  S = lambda tr(E) I + 2 mu E,
//   (f1, f2) = -A F S D^{-T},  f0 = -(f1 + f2),
//   lambda = Y nu / (1 - nu^2),  mu = Y / (2 (1 + nu)),  Y in N/m.
//
// Bending, quadratic in the positions (Bergou et al., A quadratic bending model for
// inextensible surfaces, SGP 2006): for an edge (x0, x1) between triangles with the
// opposite vertices x2, x3 and areas A0, A1, with c_i the cotangents of the angles
// between the edge and the others at rest,
//
//   f = -3 b / (A0 + A1) k (k^T x),  k = (c01 + c04, c02 + c03, -c01 - c02, -c03 -
//   c04).
//
// Air: -1/2 rho |v_n| v_n n A on each triangle with normal velocity v_n, a third to
// each vertex: quadratic in the speed. The mass is lumped, the damping that of the
// mass; steps are those of symplectic Euler, short enough not to matter (h = 0.1 ms).
//
// The mesh is irregular: a jittered grid whose diagonals alternate. Two corners are
// pinned; the cloth starts 2 % stretched and rippled, at rest in no sense but its
// speed.
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <map>
#include <random>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr int kSide = 17;      // vertices along an edge
constexpr double kSize = 1.0;  // m
constexpr int kNumFrames = 50;
constexpr double kRate = 30.0;       // frames per second
constexpr int kStepsPerFrame = 333;  // of 0.1 ms
constexpr double kYoung = 60.0;      // N/m
constexpr double kPoisson = 0.25;
constexpr double kBending = 2e-4;    // N m
constexpr double kDensity = 0.2;     // kg/m^2
constexpr double kDamping = 0.3;     // 1/s
constexpr double kAirDensity = 1.2;  // kg/m^3
constexpr double kGravity = 9.81;    // m/s^2

struct Triangle {
  std::array<int, 3> vertex;
  Matrix2d inverse_rest;  // D^{-1}, 1/m
  double area;            // m^2, at rest
};

struct Hinge {
  std::array<int, 4> vertex;
  std::array<double, 4> k;  // 1
  double factor;            // 3 b / (A0 + A1), N/m
};

double Cotangent(const Vector2d& a, const Vector2d& b) {
  return a.dot(b) / std::abs(a.x() * b.y() - a.y() * b.x());
}

class FemCloth {
 public:
  FemCloth() {
    MakeMesh();
    MakeHinges();
    mass_.assign(rest_.size(), 0.0);
    for (const Triangle& t : triangles_) {
      for (const int v : t.vertex) mass_[v] += kDensity * t.area / 3.0;
    }
    velocity_.assign(rest_.size(), Vector3d::Zero());
    for (const Vector2d& u : rest_) {
      position_.push_back(
          {1.02 * u.x(), 0.01 * std::sin(9.0 * u.x() + 7.0 * u.y()), -1.02 * u.y()});
    }
  }

  void AdvanceFrame() {
    const double h = 1.0 / kRate / kStepsPerFrame;
    for (int step = 0; step < kStepsPerFrame; ++step) {
      const std::vector<Vector3d> force = Forces();
      for (size_t v = 0; v < rest_.size(); ++v) {
        if (IsPinned(static_cast<int>(v))) continue;
        velocity_[v] += h / mass_[v] * force[v];
        position_[v] += h * velocity_[v];
      }
    }
  }

  // @return false if it cannot be written
  bool Write(const std::string& path) const {
    std::FILE* file = std::fopen(path.c_str(), "w");
    if (file == nullptr) return false;
    for (const Vector3d& x : position_) {
      std::fprintf(file, "v %.9g %.9g %.9g\n", x.x(), x.y(), x.z());
    }
    for (const Vector2d& u : rest_) std::fprintf(file, "vt %.9g %.9g\n", u.x(), u.y());
    for (const Triangle& t : triangles_) {
      const auto [a, b, c] = t.vertex;
      std::fprintf(file, "f %d/%d %d/%d %d/%d\n", a + 1, a + 1, b + 1, b + 1, c + 1,
                   c + 1);
    }
    const bool written = std::ferror(file) == 0;
    return std::fclose(file) == 0 && written;
  }

 private:
  static bool IsPinned(int v) { return v == 0 || v == kSide - 1; }

  void MakeMesh() {
    std::mt19937 generator(5);
    const double step = kSize / (kSide - 1);
    const auto jitter = [&] { return 0.2 * step * (generator() / 4294967296.0 - 0.5); };
    for (int j = 0; j < kSide; ++j) {
      for (int i = 0; i < kSide; ++i) {
        const bool inside = i > 0 && j > 0 && i < kSide - 1 && j < kSide - 1;
        const double dx = jitter(), dy = jitter();
        rest_.push_back(
            {i * step + (inside ? dx : 0.0), j * step + (inside ? dy : 0.0)});
      }
    }
    for (int j = 0; j + 1 < kSide; ++j) {
      for (int i = 0; i + 1 < kSide; ++i) {
        const int a = kSide * j + i, b = a + 1, c = a + kSide, d = c + 1;
        if ((i + j) % 2 == 0) {
          AddTriangle({a, b, d});
          AddTriangle({a, d, c});
        } else {
          AddTriangle({a, b, c});
          AddTriangle({b, d, c});
        }
      }
    }
  }

  void AddTriangle(const std::array<int, 3>& v) {
    Matrix2d edges;
    edges.col(0) = rest_[v[1]] - rest_[v[0]];
    edges.col(1) = rest_[v[2]] - rest_[v[0]];
    triangles_.push_back({v, edges.inverse(), 0.5 * std::abs(edges.determinant())});
  }

  void MakeHinges() {
    // Edge -> the opposite vertex and area of the triangle that was met first.
    std::map<std::pair<int, int>, std::pair<int, double>> open;
    for (const Triangle& t : triangles_) {
      for (int i = 0; i < 3; ++i) {
        const int a = t.vertex[i], b = t.vertex[(i + 1) % 3];
        const int opposite = t.vertex[(i + 2) % 3];
        const std::pair<int, int> edge = std::minmax(a, b);
        const auto other = open.find(edge);
        if (other == open.end()) {
          open[edge] = {opposite, t.area};
          continue;
        }
        AddHinge({edge.first, edge.second, opposite, other->second.first},
                 t.area + other->second.second);
      }
    }
  }

  void AddHinge(const std::array<int, 4>& v, double area) {
    const Vector2d e = rest_[v[1]] - rest_[v[0]];
    const double c01 = Cotangent(e, rest_[v[2]] - rest_[v[0]]);
    const double c02 = Cotangent(-e, rest_[v[2]] - rest_[v[1]]);
    const double c03 = Cotangent(-e, rest_[v[3]] - rest_[v[1]]);
    const double c04 = Cotangent(e, rest_[v[3]] - rest_[v[0]]);
    hinges_.push_back(
        {v, {c02 + c03, c01 + c04, -c01 - c02, -c03 - c04}, 3.0 * kBending / area});
  }

  std::vector<Vector3d> Forces() const {
    std::vector<Vector3d> force(rest_.size());
    for (size_t v = 0; v < rest_.size(); ++v) {
      force[v] = mass_[v] * (Vector3d(0.0, -kGravity, 0.0) - kDamping * velocity_[v]);
    }
    for (const Triangle& t : triangles_) AddTriangleForces(t, &force);
    for (const Hinge& hinge : hinges_) {
      Vector3d sum = Vector3d::Zero();
      for (int i = 0; i < 4; ++i) sum += hinge.k[i] * position_[hinge.vertex[i]];
      for (int i = 0; i < 4; ++i) {
        force[hinge.vertex[i]] -= hinge.factor * hinge.k[i] * sum;
      }
    }
    return force;
  }

  void AddTriangleForces(const Triangle& t, std::vector<Vector3d>* force) const {
    const double lambda = kYoung * kPoisson / (1.0 - kPoisson * kPoisson);
    const double mu = kYoung / (2.0 * (1.0 + kPoisson));
    const auto [a, b, c] = t.vertex;
    Eigen::Matrix<double, 3, 2> edges;
    edges.col(0) = position_[b] - position_[a];
    edges.col(1) = position_[c] - position_[a];
    const Eigen::Matrix<double, 3, 2> gradient = edges * t.inverse_rest;
    const Matrix2d strain =
        0.5 * (gradient.transpose() * gradient - Matrix2d::Identity());
    const Matrix2d stress =
        lambda * strain.trace() * Matrix2d::Identity() + 2.0 * mu * strain;
    const Eigen::Matrix<double, 3, 2> f =
        -t.area * gradient * stress * t.inverse_rest.transpose();
    const Vector3d normal_area = 0.5 * edges.col(0).cross(edges.col(1));
    const double area = normal_area.norm();
    const Vector3d normal = normal_area / area;
    const double speed = (velocity_[a] + velocity_[b] + velocity_[c]).dot(normal) / 3.0;
    const Vector3d air =
        -0.5 * kAirDensity * std::abs(speed) * speed * area / 3.0 * normal;
    (*force)[a] += air - f.col(0) - f.col(1);
    (*force)[b] += air + f.col(0);
    (*force)[c] += air + f.col(1);
  }

  std::vector<Vector2d> rest_;
  std::vector<Triangle> triangles_;
  std::vector<Hinge> hinges_;
  std::vector<double> mass_;
  std::vector<Vector3d> position_, velocity_;
};

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3 || std::strcmp(argv[1], "--output") != 0) {
    std::fprintf(stderr, "usage: fem_cloth --output FOLDER\n");
    return 1;
  }
  const std::string folder = argv[2];
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  FemCloth cloth;
  for (int frame = 0; frame < kNumFrames; ++frame) {
    if (frame > 0) cloth.AdvanceFrame();
    char name[32];
    std::snprintf(name, sizeof(name), "/frame_%04d.obj", frame);
    if (!cloth.Write(folder + name)) {
      std::fprintf(stderr, "fem_cloth: %s%s cannot be written\n", folder.c_str(), name);
      return 1;
    }
  }
  std::printf("%d frames at %g Hz in %s\n", kNumFrames, kRate, folder.c_str());
  return 0;
}
