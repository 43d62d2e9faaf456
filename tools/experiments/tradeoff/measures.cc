#include "experiments/tradeoff/measures.h"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <limits>
#include <random>
#include <vector>

#include "dpe/engine/derivative_checker.h"
#include "dpe/engine/sensitivity.h"
#include "dpe/engine/simulator.h"

namespace dpe::experiments::tradeoff {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

Eigen::MatrixXd RandomMatrix(Eigen::Index rows, Eigen::Index cols, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  return Eigen::MatrixXd::NullaryExpr(rows, cols, [&] { return normal(random); });
}

// The functional of a scene's motion and its gradient.
class Functional {
 public:
  explicit Functional(const Candidate& candidate)
      : frames_(std::min(kGradientFrames, candidate.frames)),
        simulator_(SceneOf(candidate), CandidateOptions(candidate)),
        truth_(simulator_.layout().Extract(simulator_.scene())),
        weights_(
            RandomMatrix(simulator_.scene().objects[0].positions.size(), frames_, 1)) {}

  const Eigen::VectorXd& truth() const { return truth_; }

  Eigen::VectorXd Value(const Eigen::VectorXd& p) {
    const Rollout rollout = simulator_.Run(p, frames_);
    Eigen::VectorXd value(1);
    value[0] = rollout.status().ok()
                   ? rollout.trajectory().positions[0].cwiseProduct(weights_).sum()
                   : kNan;
    return value;
  }

  // Empty on failure.
  // @param kept_mib  what the rollout keeps, unless null
  Eigen::VectorXd Gradient(double* kept_mib = nullptr) {
    const Rollout rollout = simulator_.Run(truth_, frames_);
    if (!rollout.status().ok()) return {};
    if (kept_mib != nullptr) {
      *kept_mib = static_cast<double>(rollout.kept_bytes()) / (1 << 20);
    }
    Sensitivity sensitivity(&simulator_, &rollout);
    const Eigen::VectorXd gradient = sensitivity.Gradient({weights_});
    return sensitivity.ok() ? gradient : Eigen::VectorXd();
  }

 private:
  static Scene SceneOf(const Candidate& candidate) {
    Scene scene = CandidateScene(candidate);
    scene.objects[0].stiffness_mode = ParameterMode::kLocal;
    scene.objects[0].mass_mode = ParameterMode::kFixed;
    return scene;
  }

  int frames_;
  Simulator simulator_;
  Eigen::VectorXd truth_;
  Eigen::MatrixXd weights_;
};

}  // namespace

double CpuSeconds() {
  timespec time;
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

double LeastCpuSeconds(int repeats, const std::function<void()>& call) {
  double least = std::numeric_limits<double>::infinity();
  double total = 0.0;
  for (int i = 0; i < repeats || (total < kMinMeasuredSeconds && i < kMaxRepeats);
       ++i) {
    const double start = CpuSeconds();
    call();
    const double taken = CpuSeconds() - start;
    least = std::min(least, taken);
    total += taken;
  }
  return least;
}

void SetWork(const Timings& timings, int frames, Record* row) {
  const double steps = frames - 1;
  row->Set("forces", timings.Calls(TimedPart::kForces) / steps);
  row->Set("assemblies", timings.Calls(TimedPart::kAssembly) / steps);
  row->Set("factorisations", timings.Calls(TimedPart::kFactorization) / steps);
  row->Set("solves", timings.Calls(TimedPart::kSolve) / steps);
}

GradientErrors MeasureGradient(const Candidate& candidate, bool with_difference) {
  GradientErrors errors{kNan, kNan, kNan};
  Candidate exact = candidate;
  exact.settings.solver = "cholesky";
  exact.settings.newton_tolerance = SimulatorOptions().newton_tolerance;
  exact.max_newton_iterations = SimulatorOptions().max_newton_iterations;
  Functional functional(exact);
  const Eigen::VectorXd gradient = functional.Gradient();
  if (gradient.size() == 0) return errors;
  const Eigen::VectorXd own = Functional(candidate).Gradient(&errors.kept_mib);
  if (own.size() > 0) errors.solve = (own - gradient).norm() / gradient.norm();
  if (with_difference) {
    const Eigen::VectorXd direction =
        functional.truth().cwiseProduct(RandomMatrix(gradient.size(), 1, 2).col(0));
    const Eigen::VectorXd along = Eigen::VectorXd::Constant(1, gradient.dot(direction));
    errors.difference =
        CheckDirectionalDerivative(
            [&](const Eigen::VectorXd& p) { return functional.Value(p); },
            functional.truth(), direction, along, {1e-3, 1e-4})
            .relative_error;
  }
  return errors;
}

}  // namespace dpe::experiments::tradeoff
