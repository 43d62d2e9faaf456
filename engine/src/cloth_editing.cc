// Pins, obstacles and random fields: what makes one cloth of a shape differ from
// another.
#include <cmath>
#include <cstdint>
#include <random>
#include <string>

#include "dpe/engine/cloth_builder.h"
#include "io/number_text.h"

namespace dpe {
namespace {

constexpr double kPi = 3.14159265358979323846;

// The distributions of <random> differ between standard libraries; the generator does
// not. In (0, 1).
double Uniform(std::mt19937* generator) {
  return ((*generator)() + 0.5) / 4294967296.0;
}

Eigen::Vector3d RandomDirection(std::mt19937* generator) {
  const double z = 2.0 * Uniform(generator) - 1.0;
  const double angle = 2.0 * kPi * Uniform(generator);
  const double r = std::sqrt(1.0 - z * z);
  return {r * std::cos(angle), r * std::sin(angle), z};
}

// Zero mean and unit variance; all zero where the values do not differ.
void Normalize(Eigen::VectorXd* values) {
  if (values->size() == 0) return;
  values->array() -= values->mean();
  const double deviation = std::sqrt(values->squaredNorm() / values->size());
  if (deviation > 1e-12) {
    *values /= deviation;
  } else {
    values->setZero();
  }
}

}  // namespace

int PinBox(const Eigen::Vector3d& lower, const Eigen::Vector3d& upper,
           ClothObject* cloth) {
  const Eigen::Map<const Eigen::Matrix3Xd> points(cloth->positions.data(), 3,
                                                  cloth->num_vertices());
  const double extent =
      (points.rowwise().maxCoeff() - points.rowwise().minCoeff()).maxCoeff();
  const double margin = 1e-6 * extent;
  int count = 0;
  for (int v = 0; v < cloth->num_vertices(); ++v) {
    const Eigen::Array3d p = points.col(v).array();
    if ((p >= lower.array() - margin).all() && (p <= upper.array() + margin).all()) {
      cloth->is_fixed[v] = 1;
      ++count;
    }
  }
  return count;
}

void PinVertices(const std::vector<int>& vertices, ClothObject* cloth) {
  for (int v : vertices) {
    if (v < 0 || v >= cloth->num_vertices()) {
      throw SceneError("pins: vertex " + std::to_string(v) +
                       " is not accepted; expected 0 to " +
                       std::to_string(cloth->num_vertices() - 1));
    }
    cloth->is_fixed[v] = 1;
  }
}

void UnpinAll(ClothObject* cloth) { cloth->is_fixed.assign(cloth->is_fixed.size(), 0); }

Collider SphereCollider(const Eigen::Vector3d& center, double radius) {
  Collider collider;
  collider.type = ColliderType::kSphere;
  collider.position = center;
  collider.scale.setConstant(2.0 * radius);
  return collider;
}

Eigen::VectorXd SmoothRandomField(const Eigen::Matrix3Xd& points, double sigma,
                                  double wave_length, std::uint32_t seed) {
  if (!(sigma >= 0.0) || !std::isfinite(sigma)) {
    throw SceneError("random field: sigma " + NumberText(sigma) +
                     " is not accepted; expected a finite number >= 0");
  }
  if (!(wave_length > 0.0) || !std::isfinite(wave_length)) {
    throw SceneError("random field: wave length " + NumberText(wave_length) +
                     " is not accepted; expected a finite number > 0 (m)");
  }
  constexpr int kWaves = 8;
  std::mt19937 generator(seed);
  Eigen::VectorXd z = Eigen::VectorXd::Zero(points.cols());
  for (int wave = 0; wave < kWaves; ++wave) {
    const double length = wave_length * (1.0 + 2.0 * Uniform(&generator));
    const Eigen::Vector3d k = 2.0 * kPi / length * RandomDirection(&generator);
    const double phase = 2.0 * kPi * Uniform(&generator);
    z.array() += ((k.transpose() * points).array().transpose() + phase).cos();
  }
  Normalize(&z);
  return (sigma * z.array()).exp();
}

void VaryMaterial(const MaterialVariation& variation, ClothObject* cloth) {
  const Eigen::Map<const Eigen::Matrix3Xd> points(cloth->positions.data(), 3,
                                                  cloth->num_vertices());
  Eigen::Matrix3Xd midpoints(3, cloth->num_springs());
  for (int s = 0; s < cloth->num_springs(); ++s) {
    const auto [a, b] = cloth->springs[s];
    midpoints.col(s) = 0.5 * (points.col(a) + points.col(b));
  }
  const Eigen::VectorXd stiffness_factor = SmoothRandomField(
      midpoints, variation.stiffness_sigma, variation.wave_length, variation.seed);
  // Another seed: were both fields the same, stiffness over mass would be uniform.
  const Eigen::VectorXd mass_factor =
      SmoothRandomField(points, variation.mass_sigma, variation.wave_length,
                        variation.seed ^ 0x9e3779b9u);
  cloth->stiffness.array() *= stiffness_factor.array();
  cloth->mass.array() *= mass_factor.array();
}

}  // namespace dpe
