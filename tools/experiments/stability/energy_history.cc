#include "experiments/stability/energy_history.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <sstream>

#include "dpe/engine/cloth_builder.h"
#include "dpe/engine/simulator.h"
#include "experiments/stability/stability_scene.h"

namespace dpe::experiments {
namespace {

constexpr int kFrames = 1001;
constexpr int kSampleEvery = 10;  // frames

Scene FreeCloth(IntegrationMethod method) {
  Scene scene = MakeStabilityScene("damping", 0.0).scene;
  scene.integration_method = method;
  scene.delta = 0.004;
  scene.gravity.setZero();
  scene.wind.setZero();
  ClothObject& cloth = scene.objects[0];
  UnpinAll(&cloth);
  cloth.drag_coefficient = 0.0;
  // Turning about an oblique axis, and folding.
  const Eigen::Vector3d axis(0.1, 0.2, 0.15);  // rad/s
  for (int i = 0; i < cloth.num_vertices(); ++i) {
    const Eigen::Vector3d x = cloth.positions.segment<3>(3 * i);
    auto v = cloth.velocities.segment<3>(3 * i);
    v += axis.cross(x) + Eigen::Vector3d(0.5, 0.3 * x.x(), 0.0);
  }
  return scene;
}

Eigen::Vector3d Momentum(const ClothObject& object, const Eigen::VectorXd& v) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (int i = 0; i < object.num_vertices(); ++i) {
    sum += object.mass[i] * v.segment<3>(3 * i);
  }
  return sum;
}

Eigen::Vector3d AngularMomentum(const ClothObject& object, const Eigen::VectorXd& x,
                                const Eigen::VectorXd& v) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (int i = 0; i < object.num_vertices(); ++i) {
    const Eigen::Vector3d p = object.mass[i] * v.segment<3>(3 * i);
    sum += x.segment<3>(3 * i).cross(p);
  }
  return sum;
}

std::string Joined(const std::vector<double>& values) {
  std::ostringstream text;
  text.precision(9);
  for (size_t i = 0; i < values.size(); ++i) text << (i > 0 ? " " : "") << values[i];
  return text.str();
}

double SpeedSum(const ClothObject& object) {
  double sum = 0.0;
  for (int i = 0; i < object.num_vertices(); ++i) {
    sum += object.mass[i] * object.velocities.segment<3>(3 * i).norm();
  }
  return sum;
}

}  // namespace

double Energy(const ClothObject& object, const Eigen::VectorXd& x,
              const Eigen::VectorXd& v) {
  double energy = 0.0;
  for (int i = 0; i < object.num_vertices(); ++i) {
    energy += 0.5 * object.mass[i] * v.segment<3>(3 * i).squaredNorm();
  }
  const Eigen::VectorXd rest = RestLengths(object);
  for (int s = 0; s < object.num_springs(); ++s) {
    const auto [a, b] = object.springs[s];
    const double length = (x.segment<3>(3 * a) - x.segment<3>(3 * b)).norm();
    energy += 0.5 * object.stiffness[s] * (length - rest[s]) * (length - rest[s]);
  }
  return energy;
}

Record EnergyHistory(IntegrationMethod method) {
  const Scene scene = FreeCloth(method);
  const ClothObject& object = scene.objects[0];
  const Trajectory trajectory = Simulator(scene).Simulate(kFrames);
  const RolloutStatus& status = trajectory.status;
  const int end = status.ok() ? kFrames : status.frame;
  const double start = Energy(object, object.positions, object.velocities);
  const Eigen::Vector3d p0 = Momentum(object, object.velocities);
  const Eigen::Vector3d l0 =
      AngularMomentum(object, object.positions, object.velocities);
  std::vector<double> time, energy, momentum, angular;
  for (int f = 0; f < end; f += kSampleEvery) {
    const Eigen::VectorXd x = trajectory.positions[0].col(f);
    const Eigen::VectorXd v = trajectory.velocities[0].col(f);
    time.push_back(f * scene.delta);
    energy.push_back(Energy(object, x, v) / start);
    momentum.push_back((Momentum(object, v) - p0).norm() / SpeedSum(object));
    angular.push_back((AngularMomentum(object, x, v) - l0).norm() / l0.norm());
  }
  Record row;
  row.Set("result", status.ok() ? "ok" : "failed");
  row.Set("why", status.ok() ? "" : status.Message());
  row.Set("energy_end", energy.back());
  row.Set("momentum_drift", *std::max_element(momentum.begin(), momentum.end()));
  row.Set("angular_drift", *std::max_element(angular.begin(), angular.end()));
  row.Set("time", Joined(time));
  row.Set("energy", Joined(energy));
  row.Set("momentum", Joined(momentum));
  row.Set("angular_momentum", Joined(angular));
  return row;
}

std::vector<double> ParseSamples(const std::string& text) {
  std::istringstream in(text);
  std::vector<double> values;
  double value = 0.0;
  while (in >> value) values.push_back(value);
  return values;
}

}  // namespace dpe::experiments
