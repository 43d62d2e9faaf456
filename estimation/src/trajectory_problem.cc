#include "dpe/estimation/trajectory_problem.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "reduced_problem.h"

namespace dpe {

// Copies one cost's rows of the last evaluation.
class CachedCostFunction : public ceres::CostFunction {
 public:
  CachedCostFunction(TrajectoryProblem* problem, int cost)
      : problem_(problem), first_row_(problem->evaluator()->first_row(cost)) {
    set_num_residuals(problem->evaluator()->costs()[cost]->num_residuals());
    for (const ParameterBlock& block : problem->layout().blocks()) {
      mutable_parameter_block_sizes()->push_back(block.size);
    }
  }

  bool Evaluate(double const* const* /*parameters*/, double* residuals,
                double** jacobians) const override {
    const TrajectoryEvaluator& evaluator = problem_->evaluator_;
    if (!problem_->point_ok_) return false;
    const int rows = num_residuals();
    std::copy_n(evaluator.residuals().data() + first_row_, rows, residuals);
    if (jacobians == nullptr) return true;
    if (!problem_->jacobian_ok_) return false;
    const std::vector<ParameterBlock>& blocks = problem_->layout().blocks();
    for (size_t b = 0; b < blocks.size(); ++b) {
      if (jacobians[b] == nullptr) continue;
      Eigen::Map<RowMajorMatrix>(jacobians[b], rows, blocks[b].size) =
          evaluator.jacobian().block(first_row_, blocks[b].offset, rows,
                                     blocks[b].size);
    }
    return true;
  }

 private:
  TrajectoryProblem* problem_;
  int first_row_;
};

namespace {

class AdjointFunction : public ceres::FirstOrderFunction {
 public:
  explicit AdjointFunction(TrajectoryEvaluator* evaluator) : evaluator_(evaluator) {}

  int NumParameters() const override { return evaluator_->num_parameters(); }

  bool Evaluate(const double* parameters, double* cost,
                double* gradient) const override {
    const Eigen::Map<const Eigen::VectorXd> coordinates(parameters, NumParameters());
    if (!evaluator_->Evaluate(coordinates)) return false;
    *cost = evaluator_->cost();
    if (gradient == nullptr) return true;
    Eigen::VectorXd values;
    if (!evaluator_->EvaluateGradient(&values)) return false;
    std::copy_n(values.data(), values.size(), gradient);
    return true;
  }

 private:
  TrajectoryEvaluator* evaluator_;
};

}  // namespace

TrajectoryProblem::TrajectoryProblem(const Scene& scene, TrajectoryCosts costs,
                                     const TrajectoryEvaluatorOptions& options)
    : evaluator_(scene, std::move(costs), options),
      coordinates_(Eigen::VectorXd::Zero(evaluator_.num_parameters())),
      least_squares_(ProblemOptions()) {
  std::vector<double*> blocks;
  for (const ParameterBlock& block : layout().blocks()) {
    blocks.push_back(coordinates_.data() + block.offset);
  }
  const int num_costs = static_cast<int>(evaluator_.costs().size());
  for (int cost = 0; cost < num_costs; ++cost) {
    least_squares_.AddResidualBlock(new CachedCostFunction(this, cost), nullptr,
                                    blocks);
  }
}

ceres::Problem::Options TrajectoryProblem::ProblemOptions() {
  ceres::Problem::Options options;
  options.evaluation_callback = this;
  return options;
}

void TrajectoryProblem::set_coordinates(const Eigen::VectorXd& coordinates) {
  // Ceres holds pointers into the vector: assign in place.
  std::copy_n(coordinates.data(), coordinates_.size(), coordinates_.data());
  step_origin_.resize(0);
}

double* TrajectoryProblem::block_coordinates(int block) {
  return coordinates_.data() + layout().blocks()[block].offset;
}

// Ceres has copied the point to evaluate into coordinates_ before it calls this.
void TrajectoryProblem::PrepareForEvaluation(bool evaluate_jacobians,
                                             bool /*new_point*/) {
  jacobian_ok_ = false;
  point_ok_ = !StepIsTooLong() && evaluator_.Evaluate(coordinates_);
  if (!point_ok_ || !evaluate_jacobians) return;
  jacobian_ok_ = evaluator_.EvaluateJacobian();
  step_origin_ = coordinates_;
}

bool TrajectoryProblem::StepIsTooLong() const {
  if (step_origin_.size() == 0) return false;
  for (int i = 0; i < coordinates_.size(); ++i) {
    if (evaluator_.map().is_log(i) &&
        std::abs(coordinates_[i] - step_origin_[i]) > std::log(kMaxFactor)) {
      return true;
    }
  }
  return false;
}

std::unique_ptr<ceres::Problem> TrajectoryProblem::NewReducedLeastSquares() {
  const TrajectoryEvaluatorOptions& options = evaluator_.options();
  return NewReducedProblem(&least_squares_, this, options.num_threads, options.timings,
                           options.interrupted);
}

ceres::FirstOrderFunction* TrajectoryProblem::NewFirstOrderFunction() {
  return new AdjointFunction(&evaluator_);
}

}  // namespace dpe
