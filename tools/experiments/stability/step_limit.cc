#include "experiments/stability/step_limit.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <memory>
#include <vector>

#include "dpe/engine/simulator.h"
#include "experiments/stability/contact.h"

namespace dpe::experiments {
namespace {

// Of a difference of positions (m) and velocities (m/s): exact for forces that are
// linear in velocity, and far from rounding for springs that are metres long.
constexpr double kDifference = 1e-5;
// Modes slower than this fraction of the fastest are what differences leave of zero.
constexpr double kSlow = 1e-3;
// Frames of a motion at which the limit is taken, besides the first.
constexpr int kSamples = 6;
// Different states of contact of a motion at which it is taken, at most: more than the
// campaign's scenes come through before they end or blow up.
constexpr int kContactStates = 40;

// Force per mass at the free coordinates, M^-1/2 K M^-1/2 and the same of C.
struct LinearForces {
  Eigen::MatrixXd k, c;
};

class Forces {
 public:
  explicit Forces(Scene scene) {
    scene.integration_method = IntegrationMethod::kExplicitEuler;
    simulator_ = std::make_unique<Simulator>(scene);
    const ClothObject& object = scene.objects[0];
    for (int i = 0; i < object.num_vertices(); ++i) {
      if (object.is_fixed[i]) continue;
      for (int k = 3 * i; k < 3 * i + 3; ++k) {
        free_.push_back(k);
        inverse_root_.push_back(1.0 / std::sqrt(object.mass[i]));
      }
    }
  }

  const std::vector<int>& free() const { return free_; }

  // Derivative along state[free_[j]], scaled by masses; `state` is x or v.
  Eigen::MatrixXd Difference(Eigen::VectorXd x, Eigen::VectorXd v, bool along_x) {
    Eigen::VectorXd& state = along_x ? x : v;
    const int n = static_cast<int>(free_.size());
    Eigen::MatrixXd matrix(n, n);
    for (int j = 0; j < n; ++j) {
      const double middle = state[free_[j]];
      state[free_[j]] = middle + kDifference;
      const Eigen::VectorXd after = At(x, v);
      state[free_[j]] = middle - kDifference;
      const Eigen::VectorXd before = At(x, v);
      state[free_[j]] = middle;
      for (int i = 0; i < n; ++i) {
        matrix(i, j) = (before[free_[i]] - after[free_[i]]) / (2.0 * kDifference) *
                       inverse_root_[i] * inverse_root_[j];
      }
    }
    return matrix;
  }

 private:
  // A step of explicit Euler with v1 = v0 and h = 1 has the residual -f.
  Eigen::VectorXd At(const Eigen::VectorXd& x, const Eigen::VectorXd& v) {
    Eigen::VectorXd residual;
    std::vector<Eigen::Triplet<double>> unused;
    simulator_->StepResidual(0, 1.0, x, v, x, v,
                             Eigen::VectorXd::Zero(simulator_->layout().size()),
                             &residual, &unused);
    return -residual;
  }

  std::unique_ptr<Simulator> simulator_;
  std::vector<int> free_;
  std::vector<double> inverse_root_;  // of the masses
};

Eigen::MatrixXd SymmetricPart(const Eigen::MatrixXd& m) {
  return 0.5 * (m + m.transpose());
}

double LargestEigenvalue(const Eigen::MatrixXd& symmetric) {
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(symmetric,
                                                        Eigen::EigenvaluesOnly)
      .eigenvalues()
      .maxCoeff();
}

// The h at which 4 - 2 h C - h^2 K becomes singular, by bisection of its logarithm.
double SymplecticLimit(const LinearForces& forces) {
  const Eigen::MatrixXd k = SymmetricPart(forces.k), c = SymmetricPart(forces.c);
  const auto excess = [&](double h) {
    return LargestEigenvalue(2.0 * h * c + h * h * k) - 4.0;
  };
  double low = 1e-12, high = 1e6;  // s
  if (excess(high) < 0.0) return std::numeric_limits<double>::infinity();
  while (high > 1.001 * low) {
    const double middle = std::sqrt(low * high);
    (excess(middle) < 0.0 ? low : high) = middle;
  }
  return low;
}

// s of the modes e^(st) that do not grow by themselves, the slowest left out.
std::vector<std::complex<double>> Modes(const LinearForces& forces) {
  const Eigen::Index n = forces.k.rows();
  Eigen::MatrixXd flow = Eigen::MatrixXd::Zero(2 * n, 2 * n);
  flow.topRightCorner(n, n).setIdentity();
  flow.bottomLeftCorner(n, n) = -forces.k;
  flow.bottomRightCorner(n, n) = -forces.c;
  const Eigen::VectorXcd s =
      Eigen::EigenSolver<Eigen::MatrixXd>(flow, false).eigenvalues();
  const double largest = s.cwiseAbs().maxCoeff();
  std::vector<std::complex<double>> modes;
  for (const auto& value : s) {
    const bool grows = value.real() > std::abs(value.imag());
    if (!grows && std::abs(value) > kSlow * largest) modes.push_back(value);
  }
  return modes;
}

// The largest |z| of the map (x, v) -> (x + h v1, v1), v1 = v - h (K x + C v).
double SymplecticFactor(const LinearForces& forces, double h) {
  const Eigen::Index n = forces.k.rows();
  const Eigen::MatrixXd k = SymmetricPart(forces.k), c = SymmetricPart(forces.c);
  Eigen::MatrixXd map(2 * n, 2 * n);
  const Eigen::MatrixXd one = Eigen::MatrixXd::Identity(n, n);
  map << one - h * h * k, h * one - h * h * c, -h * k, one - h * c;
  const Eigen::VectorXcd z =
      Eigen::EigenSolver<Eigen::MatrixXd>(map, false).eigenvalues();
  double factor = 0.0;
  for (const auto& value : z) {
    // Close to 1 are those that hardly move, and those that grow by themselves.
    if (value.real() < 0.0 || std::abs(value.imag()) > 1e-3) {
      factor = std::max(factor, std::abs(value));
    }
  }
  return factor;
}

}  // namespace

StepLimit PredictStepLimit(const Scene& scene, const Eigen::VectorXd& x,
                           const Eigen::VectorXd& v) {
  Forces evaluate(scene);
  LinearForces forces;
  forces.k = evaluate.Difference(x, v, true);
  forces.c = evaluate.Difference(x, v, false);
  StepLimit result;
  if (!forces.k.allFinite() || !forces.c.allFinite()) return result;
  const double h = scene.step_length();
  result.omega_max =
      std::sqrt(std::max(LargestEigenvalue(SymmetricPart(forces.k)), 0.0));
  if (scene.integration_method == IntegrationMethod::kSymplecticEuler) {
    result.limit = SymplecticLimit(forces);
    result.factor = SymplecticFactor(forces, h);
    return result;
  }
  result.limit = std::numeric_limits<double>::infinity();
  for (const std::complex<double>& s : Modes(forces)) {
    result.limit =
        std::min(result.limit, std::max(-2.0 * s.real() / std::norm(s), 0.0));
    result.factor = std::max(result.factor, std::abs(1.0 + h * s));
  }
  return result;
}

StepLimit PredictStepLimitAlong(const Scene& scene, const Eigen::MatrixXd& positions,
                                const Eigen::MatrixXd& own) {
  const ClothObject& object = scene.objects[0];
  StepLimit worst = PredictStepLimit(scene, object.positions, object.velocities);
  double log_sum = std::max(std::log(worst.factor), 0.0);
  int samples = 1;
  // Takes the state at a frame of a motion into `worst`. Returns log(factor).
  const auto add = [&](const Eigen::MatrixXd& motion, Eigen::Index f) {
    const Eigen::VectorXd v =
        f == 0 ? object.velocities
               : Eigen::VectorXd((motion.col(f) - motion.col(f - 1)) / scene.delta);
    const StepLimit here = PredictStepLimit(scene, motion.col(f), v);
    worst.omega_max = std::max(worst.omega_max, here.omega_max);
    worst.limit = std::min(worst.limit, here.limit);
    return std::max(std::log(here.factor), 0.0);
  };
  const Eigen::Index last = positions.cols() - 1;
  for (int sample = 1; sample <= kSamples && last > 0; ++sample) {
    log_sum += add(positions, std::max<Eigen::Index>(last * sample / kSamples, 1));
    ++samples;
  }
  Eigen::VectorXd in_contact = Eigen::VectorXd::Zero(object.num_vertices());
  for (const ContactState& state : ContactStates(scene, own, kContactStates)) {
    const double growth = state.count * add(own, state.frame);
    for (int i = 0; i < object.num_vertices(); ++i) {
      if (state.touching[i]) in_contact[i] += growth;
    }
  }
  worst.factor = std::exp(log_sum / samples +
                          in_contact.maxCoeff() /
                              static_cast<double>(std::max<Eigen::Index>(last, 1)));
  return worst;
}

}  // namespace dpe::experiments
