#include "reduced_problem.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "problem_rows.h"
#include "tall_qr.h"

namespace dpe {
namespace {

using FreeBlock = ProblemRows::FreeBlock;

class ReducedCost : public ceres::CostFunction {
 public:
  ReducedCost(ProblemRows rows, int num_threads, Timings* timings,
              std::function<bool()> interrupted)
      : rows_(std::move(rows)),
        num_threads_(num_threads),
        timings_(timings),
        interrupted_(std::move(interrupted)) {
    set_num_residuals(rows_.num_parameters() + 1);
    for (const FreeBlock& block : rows_.free_blocks()) {
      mutable_parameter_block_sizes()->push_back(block.size);
    }
  }

  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override {
    const ScopedTimer timer(timings_, TimedPart::kLeastSquares);
    const std::vector<FreeBlock>& blocks = rows_.free_blocks();
    for (size_t b = 0; b < blocks.size(); ++b) {
      std::copy_n(parameters[b], blocks[b].size, blocks[b].values);
    }
    const int n = rows_.num_parameters();
    Eigen::Map<Eigen::VectorXd> z(residuals, n);
    double cost = 0.0;
    if (jacobians == nullptr) {
      if (!rows_.EvaluateCost(&cost)) return false;
      z.setZero();
      residuals[n] = std::sqrt(2.0 * cost);
      return true;
    }
    Eigen::MatrixXd r;
    if (!Reduce(&cost, &r)) return false;
    z = r.col(n).head(n);
    residuals[n] = std::sqrt(std::max(0.0, 2.0 * cost - z.squaredNorm()));
    for (size_t b = 0; b < blocks.size(); ++b) {
      if (jacobians[b] == nullptr) continue;
      if (!WriteJacobian(blocks[b], r, parameters[b], jacobians[b])) return false;
    }
    return true;
  }

 private:
  // The triangular factor of [J r].
  bool Reduce(double* cost, Eigen::MatrixXd* r) const {
    std::vector<double> costs(rows_.chunk_rows().size(), 0.0);
    const bool ok = TallQr(
        rows_.chunk_rows(), rows_.num_parameters() + 1, num_threads_,
        [&](int chunk, Eigen::Ref<Eigen::MatrixXd> rows) {
          if (interrupted_ && interrupted_()) return false;
          return rows_.EvaluateChunk(chunk, rows, &costs[chunk]);
        },
        r);
    for (const double part : costs) *cost += part;
    return ok && std::isfinite(*cost);
  }

  // Ceres asks for derivatives in the ambient space and multiplies them by the
  // manifold's plus-Jacobian P. R M does, where M is its minus-Jacobian: M P = 1.
  bool WriteJacobian(const FreeBlock& block, const Eigen::MatrixXd& r,
                     const double* point, double* jacobian) const {
    const int n = rows_.num_parameters();
    Eigen::Map<RowMajorMatrix> out(jacobian, n + 1, block.size);
    out.bottomRows<1>().setZero();
    const auto columns = r.block(0, block.column, n, block.tangent_size);
    if (block.manifold == nullptr) {
      out.topRows(n) = columns;
      return true;
    }
    RowMajorMatrix minus(block.tangent_size, block.size);
    if (!block.manifold->MinusJacobian(point, minus.data())) return false;
    out.topRows(n).noalias() = columns * minus;
    return true;
  }

  mutable ProblemRows rows_;  // evaluating needs its memory
  int num_threads_;
  Timings* timings_;
  std::function<bool()> interrupted_;
};

void CopyBounds(const ceres::Problem& from, const FreeBlock& block,
                ceres::Problem* to) {
  for (int i = 0; i < block.size; ++i) {
    const double lower = from.GetParameterLowerBound(block.values, i);
    const double upper = from.GetParameterUpperBound(block.values, i);
    if (lower > -std::numeric_limits<double>::max()) {
      to->SetParameterLowerBound(block.values, i, lower);
    }
    if (upper < std::numeric_limits<double>::max()) {
      to->SetParameterUpperBound(block.values, i, upper);
    }
  }
}

}  // namespace

std::unique_ptr<ceres::Problem> NewReducedProblem(ceres::Problem* full,
                                                  ceres::EvaluationCallback* callback,
                                                  int num_threads, Timings* timings,
                                                  std::function<bool()> interrupted) {
  ProblemRows rows(full);
  if (rows.num_parameters() == 0 || rows.num_rows() <= rows.num_parameters()) {
    return nullptr;
  }
  ceres::Problem::Options options;
  options.evaluation_callback = callback;
  options.manifold_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  auto reduced = std::make_unique<ceres::Problem>(options);
  const std::vector<FreeBlock> blocks = rows.free_blocks();
  std::vector<double*> values;
  for (const FreeBlock& block : blocks) values.push_back(block.values);
  reduced->AddResidualBlock(
      new ReducedCost(std::move(rows), num_threads, timings, std::move(interrupted)),
      nullptr, values);
  for (const FreeBlock& block : blocks) {
    if (block.manifold != nullptr) {
      // Ceres keeps a pointer that can be written through, and does not.
      reduced->SetManifold(block.values, const_cast<ceres::Manifold*>(block.manifold));
    }
    CopyBounds(*full, block, reduced.get());
  }
  return reduced;
}

}  // namespace dpe
