#include "reduced_problem.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <mutex>
#include <set>
#include <utility>
#include <vector>

#include "problem_rows.h"
#include "relative_step_manifold.h"
#include "tall_qr.h"

namespace dpe {
namespace {

using FreeBlock = ProblemRows::FreeBlock;
using Group = ProblemRows::Group;

// Ceres multiplies every Jacobian by a dense plus-Jacobian: blocks with relative steps,
// whose is the identity, are cut into pieces so that this takes no time.
constexpr int kPieceSize = 32;

// A part of a parameter block that is one of its own in the reduced problem.
struct Piece {
  int offset = 0, size = 0;
};

std::vector<Piece> CutIntoPieces(const FreeBlock& block, bool has_relative_steps) {
  if (!has_relative_steps || block.manifold != nullptr) return {{0, block.size}};
  std::vector<Piece> pieces;
  for (int offset = 0; offset < block.size; offset += kPieceSize) {
    pieces.push_back({offset, std::min(kPieceSize, block.size - offset)});
  }
  return pieces;
}

// What the costs of one reduced problem have in common.
struct SharedRows {
  SharedRows(ProblemRows r, std::function<bool()> i,
             const std::set<const double*>& relative)
      : rows(std::move(r)), interrupted(std::move(i)) {
    for (const FreeBlock& block : rows.free_blocks()) {
      pieces.push_back(CutIntoPieces(block, relative.count(block.values) > 0));
    }
  }
  ProblemRows rows;                        // evaluating needs its memory
  std::vector<std::vector<Piece>> pieces;  // of each free block
  std::function<bool()> interrupted;
  std::mutex mutex;  // and that of the full problem

  ceres::Manifold* RelativeSteps(int size) {
    std::unique_ptr<RelativeStepManifold>& manifold = manifolds_[size];
    if (!manifold) manifold = std::make_unique<RelativeStepManifold>(size);
    return manifold.get();
  }

 private:
  std::map<int, std::unique_ptr<RelativeStepManifold>> manifolds_;  // by size
};

// One group of rows, (z, t) of the header; or, where it has no more rows than columns,
// the rows as they are in place of z.
class ReducedCost : public ceres::CostFunction {
 public:
  ReducedCost(std::shared_ptr<SharedRows> shared, int group, int num_threads,
              Timings* timings)
      : shared_(std::move(shared)),
        group_index_(group),
        group_(shared_->rows.groups()[group]),
        num_threads_(num_threads),
        timings_(timings) {
    num_rows_ = std::min(group_.num_rows, group_.num_columns);
    set_num_residuals(num_rows_ + 1);
    for (size_t b = 0; b < group_.free_blocks.size(); ++b) {
      for (const Piece& piece : shared_->pieces[group_.free_blocks[b]]) {
        mutable_parameter_block_sizes()->push_back(piece.size);
        pieces_.push_back({static_cast<int>(b), piece});
      }
    }
  }

  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override {
    const std::lock_guard<std::mutex> lock(shared_->mutex);
    const ScopedTimer timer(timings_, TimedPart::kLeastSquares);
    for (size_t k = 0; k < pieces_.size(); ++k) {
      const auto& [b, piece] = pieces_[k];
      std::copy_n(parameters[k], piece.size,
                  FreeBlocks()[group_.free_blocks[b]].values + piece.offset);
    }
    Eigen::Map<Eigen::VectorXd> z(residuals, num_rows_);
    double cost = 0.0;
    if (jacobians == nullptr) {
      if (!shared_->rows.EvaluateCost(group_index_, &cost)) return false;
      z.setZero();
      residuals[num_rows_] = std::sqrt(2.0 * cost);
      return true;
    }
    Eigen::MatrixXd r;
    if (!Reduce(&cost, &r)) return false;
    z = r.col(group_.num_columns).head(num_rows_);
    residuals[num_rows_] = std::sqrt(std::max(0.0, 2.0 * cost - z.squaredNorm()));
    for (size_t k = 0; k < pieces_.size(); ++k) {
      if (jacobians[k] == nullptr) continue;
      if (!WriteJacobian(pieces_[k].first, pieces_[k].second, r, parameters[k],
                         jacobians[k])) {
        return false;
      }
    }
    return true;
  }

 private:
  const std::vector<FreeBlock>& FreeBlocks() const {
    return shared_->rows.free_blocks();
  }

  // The triangular factor of [J r], or [J r] itself.
  bool Reduce(double* cost, Eigen::MatrixXd* r) const {
    std::vector<double> costs(group_.chunk_rows.size(), 0.0);
    const auto fill = [&](int chunk, Eigen::Ref<Eigen::MatrixXd> rows) {
      if (shared_->interrupted && shared_->interrupted()) return false;
      return shared_->rows.EvaluateChunk(group_index_, chunk, rows, &costs[chunk]);
    };
    bool ok = true;
    if (group_.num_rows > group_.num_columns) {
      ok = TallQr(group_.chunk_rows, group_.num_columns + 1, num_threads_, fill, r);
    } else {
      r->resize(group_.num_rows, group_.num_columns + 1);
      int row = 0;
      for (size_t chunk = 0; ok && chunk < group_.chunk_rows.size(); ++chunk) {
        const int count = group_.chunk_rows[chunk];
        Eigen::MatrixXd rows(count, group_.num_columns + 1);
        ok = fill(static_cast<int>(chunk), rows);
        r->middleRows(row, count) = rows;
        row += count;
      }
    }
    for (const double part : costs) *cost += part;
    return ok && std::isfinite(*cost);
  }

  // Ceres asks for derivatives in the ambient space and multiplies them by the
  // manifold's plus-Jacobian P. R M does, where M is its minus-Jacobian: M P = 1.
  bool WriteJacobian(int b, const Piece& piece, const Eigen::MatrixXd& r,
                     const double* point, double* jacobian) const {
    const FreeBlock& block = FreeBlocks()[group_.free_blocks[b]];
    Eigen::Map<RowMajorMatrix> out(jacobian, num_rows_ + 1, piece.size);
    out.bottomRows<1>().setZero();
    if (block.manifold == nullptr) {
      out.topRows(num_rows_) =
          r.block(0, group_.columns[b] + piece.offset, num_rows_, piece.size);
      return true;
    }
    const auto columns = r.block(0, group_.columns[b], num_rows_, block.tangent_size);
    RowMajorMatrix minus(block.tangent_size, block.size);
    if (!block.manifold->MinusJacobian(point, minus.data())) return false;
    out.topRows(num_rows_).noalias() = columns * minus;
    return true;
  }

  std::shared_ptr<SharedRows> shared_;
  int group_index_;
  const Group& group_;
  // (index into group_.free_blocks, piece), one per parameter block of this cost.
  std::vector<std::pair<int, Piece>> pieces_;
  int num_rows_ = 0;  // of z
  int num_threads_;
  Timings* timings_;
};

void CopyBounds(const ceres::Problem& from, const FreeBlock& block, const Piece& piece,
                ceres::Problem* to) {
  double* values = block.values + piece.offset;
  for (int i = 0; i < piece.size; ++i) {
    const double lower = from.GetParameterLowerBound(block.values, piece.offset + i);
    const double upper = from.GetParameterUpperBound(block.values, piece.offset + i);
    if (lower > -std::numeric_limits<double>::max()) {
      to->SetParameterLowerBound(values, i, lower);
    }
    if (upper < std::numeric_limits<double>::max()) {
      to->SetParameterUpperBound(values, i, upper);
    }
  }
}

}  // namespace

std::unique_ptr<ceres::Problem> NewReducedProblem(
    ceres::Problem* full, ceres::EvaluationCallback* callback, int num_threads,
    Timings* timings, std::function<bool()> interrupted,
    const std::set<const double*>& relative) {
  auto shared =
      std::make_shared<SharedRows>(ProblemRows(full), std::move(interrupted), relative);
  const ProblemRows& rows = shared->rows;
  if (rows.num_parameters() == 0 || rows.num_rows() <= rows.num_parameters()) {
    return nullptr;
  }
  ceres::Problem::Options options;
  options.evaluation_callback = callback;
  options.manifold_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  auto reduced = std::make_unique<ceres::Problem>(options);
  const std::vector<FreeBlock>& blocks = rows.free_blocks();
  for (int g = 0; g < static_cast<int>(rows.groups().size()); ++g) {
    std::vector<double*> values;
    for (int free : rows.groups()[g].free_blocks) {
      for (const Piece& piece : shared->pieces[free]) {
        values.push_back(blocks[free].values + piece.offset);
      }
    }
    reduced->AddResidualBlock(new ReducedCost(shared, g, num_threads, timings), nullptr,
                              values);
  }
  for (size_t b = 0; b < blocks.size(); ++b) {
    const FreeBlock& block = blocks[b];
    for (const Piece& piece : shared->pieces[b]) {
      ceres::Manifold* manifold = const_cast<ceres::Manifold*>(block.manifold);
      if (manifold == nullptr && relative.count(block.values) > 0) {
        manifold = shared->RelativeSteps(piece.size);
      }
      // Ceres keeps a pointer that can be written through, and does not.
      if (manifold != nullptr) {
        reduced->SetManifold(block.values + piece.offset, manifold);
      }
      CopyBounds(*full, block, piece, reduced.get());
    }
  }
  return reduced;
}

}  // namespace dpe
