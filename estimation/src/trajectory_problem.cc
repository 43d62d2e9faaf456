#include "dpe/estimation/trajectory_problem.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>
#include <vector>

#include "prior_cost_function.h"
#include "reduced_problem.h"

namespace dpe {

// Copies one cost's rows of the last evaluation. Parameter blocks are the joint ones of
// its segment, then, for a link, the blocks of the initial state that it leads to.
class CachedCostFunction : public ceres::CostFunction {
 public:
  CachedCostFunction(TrajectoryProblem* problem, int cost)
      : problem_(problem),
        cost_(cost),
        segment_(problem->evaluator()->segment_of_cost(cost)),
        first_row_(problem->evaluator()->first_row(cost)) {
    TrajectoryEvaluator& evaluator = *problem->evaluator();
    set_num_residuals(evaluator.costs()[cost]->num_residuals());
    row_in_segment_ = first_row_ - evaluator.first_row_of_segment(segment_);
    const JointLayout& joint = evaluator.joint_layout();
    const std::vector<int>& indices = joint.indices(segment_);
    for (int b : joint.blocks(segment_)) AddBlock(b);
    for (Block& block : blocks_) {
      const ParameterBlock& of_joint = joint.layout().blocks()[block.joint];
      for (int k = 0; k < static_cast<int>(indices.size()); ++k) {
        const int column = indices[k] - of_joint.offset;
        if (column < 0 || column >= of_joint.size) continue;
        if (block.columns.empty()) block.first = k;
        block.columns.push_back(column);
      }
    }
    AddLinkBlocks(evaluator);
  }

  // Joint blocks, in the order of the parameters.
  std::vector<int> joint_blocks() const {
    std::vector<int> result;
    for (const Block& block : blocks_) result.push_back(block.joint);
    return result;
  }

  bool Evaluate(double const* const* /*parameters*/, double* residuals,
                double** jacobians) const override {
    const TrajectoryEvaluator& evaluator = problem_->evaluator_;
    if (!problem_->point_ok_) return false;
    std::copy_n(evaluator.residuals().data() + first_row_, num_residuals(), residuals);
    if (jacobians == nullptr) return true;
    if (!problem_->jacobian_ok_) return false;
    for (size_t b = 0; b < blocks_.size(); ++b) {
      if (jacobians[b] != nullptr) WriteJacobian(blocks_[b], jacobians[b]);
    }
    return true;
  }

 private:
  struct Block {
    int joint = 0;   // index into the joint layout's blocks
    int offset = 0;  // in the joint vector
    int size = 0;
    // The segment's own columns first, first + 1, ... are these of the block.
    int first = 0;
    std::vector<int> columns;
  };

  void AddBlock(int joint) {
    const ParameterBlock& block = problem_->layout().blocks()[joint];
    mutable_parameter_block_sizes()->push_back(block.size);
    blocks_.push_back({joint, block.offset, block.size, 0, {}});
  }

  void AddLinkBlocks(const TrajectoryEvaluator& evaluator) {
    const int to = evaluator.LinkTarget(cost_);
    if (to < 0) return;
    const JointLayout& joint = evaluator.joint_layout();
    for (int b : joint.blocks(to)) {
      const ParameterBlock& block = joint.layout().blocks()[b];
      if (block.segment == to && block.kind != ParameterKind::kWind) AddBlock(b);
    }
  }

  void WriteJacobian(const Block& block, double* jacobian) const {
    const TrajectoryEvaluator& evaluator = problem_->evaluator_;
    const int rows = num_residuals();
    const int count = static_cast<int>(block.columns.size());
    Eigen::Map<RowMajorMatrix> out(jacobian, rows, block.size);
    const auto own =
        evaluator.jacobian(segment_).block(row_in_segment_, block.first, rows, count);
    if (count == block.size) {  // then they are in order
      out = own;
      return;
    }
    out.setZero();
    for (int k = 0; k < count; ++k) out.col(block.columns[k]) = own.col(k);
    if (count > 0) return;
    const auto terms = evaluator.LinkTerms(cost_);
    for (int row = 0; row < static_cast<int>(terms.size()); ++row) {
      const int column = terms[row].parameter - block.offset;
      if (column >= 0 && column < block.size) out(row, column) = -terms[row].weight;
    }
  }

  TrajectoryProblem* problem_;
  int cost_;
  int segment_;
  int first_row_;
  int row_in_segment_ = 0;
  std::vector<Block> blocks_;
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
  AddCosts();
}

TrajectoryProblem::TrajectoryProblem(std::vector<TrajectorySegment> segments,
                                     std::vector<SegmentLink> links,
                                     const TrajectoryEvaluatorOptions& options)
    : evaluator_(std::move(segments), std::move(links), options),
      coordinates_(Eigen::VectorXd::Zero(evaluator_.num_parameters())),
      least_squares_(ProblemOptions()) {
  AddCosts();
}

void TrajectoryProblem::AddCosts() {
  const int num_costs = static_cast<int>(evaluator_.costs().size());
  for (int cost = 0; cost < num_costs; ++cost) {
    auto* function = new CachedCostFunction(this, cost);
    std::vector<double*> blocks;
    for (int block : function->joint_blocks()) {
      blocks.push_back(block_coordinates(block));
    }
    least_squares_.AddResidualBlock(function, nullptr, blocks);
  }
  const PriorRows& rows = evaluator_.prior_rows();
  for (const PriorRows::Piece& piece : rows.pieces()) {
    least_squares_.AddResidualBlock(
        new PriorCostFunction(&rows, piece, layout().blocks()[piece.block]), nullptr,
        block_coordinates(piece.block));
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
  // A handful of values is found in whatever coordinates; hundreds that make up for
  // each other are not (relative_step_manifold.h).
  std::set<const double*> relative;
  for (int b = 0; b < static_cast<int>(layout().blocks().size()); ++b) {
    const ParameterBlock& block = layout().blocks()[b];
    if (block.mode == ParameterMode::kLocal && ParameterKindIsPositive(block.kind)) {
      relative.insert(block_coordinates(b));
    }
  }
  return NewReducedProblem(&least_squares_, this, options.num_threads, options.timings,
                           options.interrupted, relative);
}

ceres::FirstOrderFunction* TrajectoryProblem::NewFirstOrderFunction() {
  return new AdjointFunction(&evaluator_);
}

}  // namespace dpe
