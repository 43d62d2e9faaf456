#include "linear/multigrid.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "linear/vectorize.h"

namespace dpe {
namespace {

constexpr int kDenseNodes = 8;      // solved by dense LU
constexpr double kMaxRatio = 0.75;  // a level that shrinks less is the last
constexpr int kMaxLevels = 20;

// A power of two that brings the diagonal to about 1, so that no unit of mass leaves
// the range of single precision. 0 if there is none.
double Scale(const BlockPattern& pattern, const std::vector<int>& diagonal,
             const double* values) {
  double largest = 0.0;
  for (int j = 0; j < pattern.num_nodes(); ++j) {
    const int first = pattern.block_starts()[j];
    const int stride = 3 * (pattern.block_starts()[j + 1] - first);
    const double* block = values + 9 * static_cast<size_t>(first) +
                          3 * static_cast<size_t>(diagonal[j] - first);
    for (int c = 0; c < 3; ++c) {
      largest = std::max(largest, std::abs(block[c * stride + c]));
    }
  }
  if (!(largest > 0.0) || !std::isfinite(largest)) return 0.0;
  return std::ldexp(1.0, -std::ilogb(largest));
}

// Rows of A^T are columns of A: blocks [first, last) of column j, in places from
// `place` on.
inline void CopyColumn(const double* column, int stride, int first, int last,
                       float scale, float* out) {
  for (int k = first; k < last; ++k, out += 9) {
    for (int c = 0; c < 3; ++c) {
      for (int r = 0; r < 3; ++r) {
        out[3 * c + r] = scale * static_cast<float>(column[3 * k + r * stride + c]);
      }
    }
  }
}

DPE_VECTORIZE
void CopyTransposed(const int* starts, const int* diagonal, const double* values,
                    float scale, SingleRows::Rows rows, float* out) {
  const size_t first_diagonal = rows.lower_starts[rows.num_nodes];
  for (int j = 0; j < rows.num_nodes; ++j) {
    const int count = starts[j + 1] - starts[j], own = diagonal[j] - starts[j];
    const double* column = values + 9 * static_cast<size_t>(starts[j]);
    CopyColumn(column, 3 * count, 0, own, scale,
               out + 9 * static_cast<size_t>(rows.lower_starts[j]));
    CopyColumn(column, 3 * count, own, own + 1, scale, out + 9 * (first_diagonal + j));
    CopyColumn(column, 3 * count, own + 1, count, scale,
               out + 9 * static_cast<size_t>(rows.upper_starts[j]));
  }
}

// `next` is scratch space: the place of each row's next block. Columns come in order,
// so that rows are filled from their first block to their last.
DPE_VECTORIZE
void CopyRows(const int* starts, const int* row_of_block, const double* values,
              float scale, SingleRows::Rows rows, int* next, float* out) {
  const size_t first_diagonal = rows.lower_starts[rows.num_nodes];
  for (int i = 0; i < rows.num_nodes; ++i) next[i] = rows.lower_starts[i];
  for (int j = 0; j < rows.num_nodes; ++j) {
    const int stride = 3 * (starts[j + 1] - starts[j]);
    const double* column = values + 9 * static_cast<size_t>(starts[j]);
    for (int k = starts[j]; k < starts[j + 1]; ++k, column += 3) {
      const int i = row_of_block[k];
      size_t place = first_diagonal + j;
      if (i != j) {
        place = next[i]++;
      } else {
        next[i] = rows.upper_starts[i];
      }
      float* block = out + 9 * place;
      for (int c = 0; c < 3; ++c) {
        for (int r = 0; r < 3; ++r) {
          block[3 * c + r] = scale * static_cast<float>(column[c * stride + r]);
        }
      }
    }
  }
}

}  // namespace

void Multigrid::AddLevel(SingleRows matrix) {
  levels_.emplace_back();
  Level& level = levels_.back();
  level.matrix = std::move(matrix);
  level.residual.resize(3 * static_cast<size_t>(level.matrix.num_nodes()));
}

bool Multigrid::Compute(const BlockPattern& pattern, const double* values,
                        bool transposed) {
  if (levels_.empty()) {
    AddLevel(SingleRows(pattern.block_starts(), pattern.block_rows()));
  }
  SingleRows& finest = levels_[0].matrix;
  scale_ = Scale(pattern, finest.diagonal(), values);
  if (scale_ == 0.0) return false;
  if (transposed) {
    CopyTransposed(pattern.block_starts().data(), finest.diagonal().data(), values,
                   static_cast<float>(scale_), finest.rows(), finest.values());
  } else {
    next_.resize(pattern.num_nodes());
    CopyRows(pattern.block_starts().data(), pattern.block_rows().data(), values,
             static_cast<float>(scale_), finest.rows(), next_.data(), finest.values());
  }
  for (size_t l = 0;; ++l) {
    if (!levels_[l].matrix.InvertDiagonal()) return false;
    if (!built_ && levels_[l].matrix.num_nodes() > kDenseNodes && l < kMaxLevels) {
      SingleRows coarse;
      Prolongation coarser(levels_[l].matrix, &coarse);
      if (coarser.num_coarse() < kMaxRatio * levels_[l].matrix.num_nodes()) {
        levels_[l].coarse_r.resize(3 * static_cast<size_t>(coarse.num_nodes()));
        levels_[l].coarse_z.resize(3 * static_cast<size_t>(coarse.num_nodes()));
        levels_[l].coarser.push_back(std::move(coarser));
        AddLevel(std::move(coarse));
      }
    }
    if (levels_[l].coarser.empty()) break;
    levels_[l].coarser[0].Update(levels_[l].matrix, &levels_[l + 1].matrix);
  }
  built_ = true;
  return FactorizeCoarsest();
}

bool Multigrid::FactorizeCoarsest() {
  const SingleRows& a = levels_.back().matrix;
  dense_ = a.num_nodes() <= kDenseNodes;
  if (!dense_) return true;
  coarsest_.setZero(3 * a.num_nodes(), 3 * a.num_nodes());
  for (int i = 0; i < a.num_nodes(); ++i) {
    for (int k = a.starts()[i]; k < a.starts()[i + 1]; ++k) {
      coarsest_.block<3, 3>(3 * i, 3 * a.columns()[k]) =
          Eigen::Map<const Eigen::Matrix3f>(a.block(i, k));
    }
  }
  lu_.compute(coarsest_);
  return lu_.matrixLU().allFinite() &&
         lu_.matrixLU().diagonal().cwiseAbs().minCoeff() > 0.0f;
}

void Multigrid::Cycle(int l, const float* r, float* z) {
  Level& level = levels_[l];
  if (level.coarser.empty() && dense_) {
    const Eigen::Index n = 3 * static_cast<Eigen::Index>(level.matrix.num_nodes());
    Eigen::Map<Eigen::VectorXf>(z, n) =
        lu_.solve(Eigen::Map<const Eigen::VectorXf>(r, n));
    return;
  }
  level.matrix.SweepForward(r, z, level.residual.data());
  if (!level.coarser.empty()) {
    level.coarser[0].Restrict(level.residual.data(), level.coarse_r.data());
    Cycle(l + 1, level.coarse_r.data(), level.coarse_z.data());
    level.coarser[0].AddProlonged(level.coarse_z.data(), z);
  }
  level.matrix.SweepBackward(r, z);
}

double Multigrid::complexity() const {
  double blocks = 0.0;
  for (const Level& level : levels_) blocks += level.matrix.num_blocks();
  return blocks / levels_[0].matrix.num_blocks();
}

}  // namespace dpe
