#include "dpe/estimation/inverse_dynamics.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include "sparse_least_squares.h"
#include "starting_point.h"
#include "step_equations.h"

namespace dpe {
namespace {

// Gauss-Newton steps for the products of unknowns; it converges quadratically.
constexpr int kMaxGaussNewtonIterations = 30;

// Gauss-Newton has converged when the residual changes by less than this fraction, or
// the parameters (their norm) by less than that one: quadratic convergence makes the
// step after it one of rounding.
constexpr double kConverged = 1e-3;
constexpr double kRoundingStep = 1e-9;

// Corrections with the same factorization: each gains digits until rounding.
constexpr int kMaxRefinements = 3;

// A value that came out negative or zero becomes this fraction of its block's median.
constexpr double kClampFraction = 1e-2;

// The equations are homogeneous if what is left of them without any parameter is below
// this fraction of the weight of the object.
constexpr double kHomogeneous = 1e-10;

class InverseDynamics {
 public:
  InverseDynamics(const std::vector<InverseDynamicsMotion>& motions,
                  const JointLayout& joint, const std::vector<double>& total_mass)
      : motions_(motions),
        layout_(joint.layout()),
        equations_(motions, joint),
        total_mass_(total_mass),
        p_(Eigen::VectorXd::Zero(layout_.size())) {}

  InverseDynamicsResult Solve() {
    FixGauges();
    if (!Iterate()) {
      result_.message = "inverse dynamics: the least-squares problem is too large";
      return result_;
    }
    FillUndetermined();
    NormaliseGauges();
    EstimateInitialStates();
    ClampToPositive();
    result_.parameters = p_;
    result_.ok = p_.allFinite();
    if (!result_.ok)
      result_.message = "inverse dynamics gave a number that is not finite";
    return result_;
  }

 private:
  bool IsEstimated(ParameterKind kind, int object) const {
    for (const ParameterBlock& block : layout_.blocks()) {
      if (block.kind == kind && (object < 0 || block.object == object)) return true;
    }
    return false;
  }

  // True if unknowns multiply each other, so that one linear solve is not enough.
  bool HasProducts() const {
    for (int object : equations_.objects()) {
      if (IsEstimated(ParameterKind::kDamping, object) &&
          (IsEstimated(ParameterKind::kMass, object) ||
           IsEstimated(ParameterKind::kStiffness, object))) {
        return true;
      }
    }
    return IsEstimated(ParameterKind::kWind, -1) &&
           IsEstimated(ParameterKind::kDrag, -1);
  }

  void FixGauges() {
    Eigen::VectorXd constant;
    Eigen::SparseMatrix<double> jacobian;
    equations_.Evaluate(p_, &constant, &jacobian);
    for (int object : equations_.objects()) {
      if (!IsEstimated(ParameterKind::kMass, object)) continue;
      const auto impulse = [&](const Scene& scene) {
        return total_mass_[object] / scene.objects[object].num_vertices() *
               std::max(scene.gravity.norm(), 1.0) * scene.delta;
      };
      if (equations_.ObjectRms(constant, object, impulse) > kHomogeneous) continue;
      gauged_objects_.push_back(object);
      double longest = 0.0;
      for (const ParameterBlock& block : layout_.blocks()) {
        if (block.object != object || block.kind != ParameterKind::kMass) continue;
        for (int j = 0; j < block.size; ++j) {
          longest = std::max(longest, jacobian.col(block.offset + j).norm());
        }
      }
      // Homogeneous equations have the same solution up to its length whatever the
      // weight; this one keeps the row in proportion to the others.
      equations_.FixTotalMass(object, total_mass_[object], longest);
      result_.notes.push_back(ScaleNote(object, total_mass_[object]));
    }
  }

  // One solve if the equations are linear, else Gauss-Newton from 0. False if a
  // factorization failed.
  bool Iterate() {
    if (!HasProducts()) return GaussNewtonStep(/*refine=*/true);
    Eigen::VectorXd best = p_;
    double best_norm = std::numeric_limits<double>::infinity();
    double previous_norm = best_norm;
    bool converged = false;
    for (int i = 0; i < kMaxGaussNewtonIterations && !converged; ++i) {
      if (!GaussNewtonStep(/*refine=*/false)) return false;
      // The first steps may well raise the residual: products of unknowns that are
      // still 0 are left out of the linear model.
      const double norm = result_.residual_norm;
      converged = step_norm_ <= kRoundingStep * p_.norm() ||
                  std::abs(norm - previous_norm) <= kConverged * norm;
      previous_norm = norm;
      if (norm < best_norm) {
        best_norm = norm;
        best = p_;
      }
    }
    if (!converged) {
      p_ = best;
      result_.residual_norm = best_norm;
      result_.notes.push_back(
          "inverse dynamics: the iteration for products of unknowns (damping with mass "
          "and stiffness, wind with drag) did not converge; its best point is a start "
          "only");
    }
    return true;
  }

  bool GaussNewtonStep(bool refine) {
    Eigen::VectorXd residual;
    Eigen::SparseMatrix<double> jacobian;
    equations_.Evaluate(p_, &residual, &jacobian);
    const SparseLeastSquares factored(jacobian);
    if (!factored.ok()) return false;
    const Eigen::VectorXd step = factored.Solve(-residual);
    step_norm_ = step.norm();
    p_ += step;
    ++result_.iterations;
    is_dead_.assign(layout_.size(), 0);
    for (int j = 0; j < layout_.size(); ++j) is_dead_[j] = factored.is_dead(j);
    if (refine) Refine(factored);
    equations_.Evaluate(p_, &residual, nullptr);
    result_.residual_norm = residual.norm();
    return true;
  }

  // Residuals at the solution are computed afresh from the states, so correcting by
  // them removes what the factorization's rounding left.
  void Refine(const SparseLeastSquares& factored) {
    Eigen::VectorXd residual;
    double previous = std::numeric_limits<double>::infinity();
    for (int i = 0; i < kMaxRefinements; ++i) {
      equations_.Evaluate(p_, &residual, nullptr);
      const Eigen::VectorXd correction = factored.Solve(-residual);
      if (!(correction.norm() < 0.5 * previous)) break;
      previous = correction.norm();
      p_ += correction;
      ++result_.iterations;
    }
  }

  // Median of the block's values that are determined and positive; NaN without any.
  double Median(const ParameterBlock& block) const {
    std::vector<double> values;
    for (int j = block.offset; j < block.offset + block.size; ++j) {
      if (!is_dead_[j] && p_[j] > 0.0) values.push_back(p_[j]);
    }
    if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
    std::nth_element(values.begin(), values.begin() + values.size() / 2, values.end());
    return values[values.size() / 2];
  }

  const Scene& SceneOf(int segment) const {
    for (const InverseDynamicsMotion& motion : motions_) {
      if (motion.segment == segment) return motion.simulator->scene();
    }
    return motions_[0].simulator->scene();
  }

  void FillUndetermined() {
    for (const ParameterBlock& block : layout_.blocks()) {
      if (!ParameterKindIsPositive(block.kind)) continue;
      const double median = Median(block);
      int count = 0;
      for (int j = block.offset; j < block.offset + block.size; ++j) {
        if (!is_dead_[j]) continue;
        result_.undetermined.push_back(j);
        if (std::isfinite(median)) p_[j] = median;
        ++count;
      }
      if (count == 0) continue;
      result_.notes.push_back(
          std::to_string(count) + " of " + std::to_string(block.size) + " values of " +
          ParameterKindName(block.kind) + " of object " + std::to_string(block.object) +
          " are not determined by the motion; they start at the "
          "median of the others");
    }
  }

  // With noise the least-squares solution shrinks: bring the total back exactly.
  void NormaliseGauges() {
    for (int object : gauged_objects_) {
      double sum = 0.0;
      for (const ParameterBlock& block : layout_.blocks()) {
        if (block.object != object || block.kind != ParameterKind::kMass) continue;
        for (int local : block.element_to_local) {
          if (local >= 0) sum += p_[block.offset + local];
        }
      }
      if (!(sum > 0.0)) continue;
      for (const ParameterBlock& block : layout_.blocks()) {
        if (block.object == object && (block.kind == ParameterKind::kMass ||
                                       block.kind == ParameterKind::kStiffness ||
                                       block.kind == ParameterKind::kDrag)) {
          p_.segment(block.offset, block.size) *= total_mass_[object] / sum;
        }
      }
    }
  }

  void EstimateInitialStates() {
    for (const ParameterBlock& block : layout_.blocks()) {
      Eigen::VectorXd state;
      const ObservedMotion* motion = equations_.motion(block.object, block.segment);
      if (block.kind == ParameterKind::kInitialVelocity && motion != nullptr) {
        state = motion->InitialVelocity();
      } else if (block.kind == ParameterKind::kInitialPosition && motion != nullptr) {
        // The motion is taken to start where the scene says.
        state = SceneOf(block.segment).objects[block.object].positions;
      } else {
        continue;
      }
      for (size_t e = 0; e < block.element_to_local.size(); ++e) {
        const int local = block.element_to_local[e];
        if (local >= 0) p_[block.offset + local] = state[e];
      }
    }
  }

  void ClampToPositive() {
    for (const ParameterBlock& block : layout_.blocks()) {
      if (!ParameterKindIsPositive(block.kind)) continue;
      const double median = Median(block);
      const double floor = std::isfinite(median) ? kClampFraction * median : 1e-3;
      int count = 0;
      for (int j = block.offset; j < block.offset + block.size; ++j) {
        if (p_[j] > 0.0) continue;
        p_[j] = floor;
        ++count;
      }
      if (count == 0) continue;
      std::ostringstream note;
      note << count << " of " << block.size << " values of "
           << ParameterKindName(block.kind) << " of object " << block.object
           << " came out of inverse dynamics at or below zero and start at " << floor
           << " " << ParameterKindUnit(block.kind);
      result_.notes.push_back(note.str());
    }
  }

  const std::vector<InverseDynamicsMotion>& motions_;
  const ParameterLayout& layout_;
  StepEquations equations_;
  std::vector<double> total_mass_;
  std::vector<int> gauged_objects_;
  Eigen::VectorXd p_;
  double step_norm_ = 0.0;  // of the last Gauss-Newton step
  std::vector<char> is_dead_;
  InverseDynamicsResult result_;
};

}  // namespace

bool InverseDynamicsApplies(const Scene& scene, const Observations& observations) {
  for (int object = 0; object < static_cast<int>(scene.objects.size()); ++object) {
    if (ParameterLayout::ObjectIsEstimated(scene, object) &&
        !observations.IsComplete(scene, object)) {
      return false;
    }
  }
  return true;
}

namespace {

// The frames that the equations of a motion need.
int MinFrames(const Scene& scene) {
  bool needs_third_frame =
      scene.integration_method == IntegrationMethod::kExplicitEuler;
  for (const ClothObject& object : scene.objects) {
    needs_third_frame = needs_third_frame || object.estimate_initial_velocity;
  }
  return needs_third_frame ? 3 : 2;
}

void RequireComplete(const Scene& scene, const Observations& observations) {
  if (!InverseDynamicsApplies(scene, observations)) {
    throw SceneError(
        "inverse dynamics needs every free vertex of the estimated objects observed at "
        "every frame; with fewer observations use --init=screen, scene or "
        "uniform:VALUE");
  }
}

}  // namespace

InverseDynamicsResult SolveInverseDynamics(Simulator* simulator,
                                           const Observations& observations,
                                           int num_frames,
                                           const std::vector<double>& total_mass) {
  const JointLayout joint({&simulator->scene()}, /*own_wind=*/true);
  return SolveInverseDynamics({{simulator, &observations, num_frames, 0}}, joint,
                              total_mass);
}

InverseDynamicsResult SolveInverseDynamics(
    const std::vector<InverseDynamicsMotion>& motions, const JointLayout& joint,
    const std::vector<double>& total_mass) {
  for (const InverseDynamicsMotion& motion : motions) {
    const Scene& scene = motion.simulator->scene();
    RequireComplete(scene, *motion.observations);
    if (motion.num_frames >= MinFrames(scene)) continue;
    InverseDynamicsResult result;
    result.message = "inverse dynamics needs at least " +
                     std::to_string(MinFrames(scene)) + " frames";
    return result;
  }
  return InverseDynamics(motions, joint, total_mass).Solve();
}

}  // namespace dpe
