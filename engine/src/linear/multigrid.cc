#include "linear/multigrid.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "linear/vectorize.h"

namespace dpe {
namespace {

constexpr int kDenseNodes = 8;       // solved by dense LU
constexpr double kMaxRatio = 0.75;   // a level that shrinks less is the last
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

// Rows of A^T are columns of A.
DPE_VECTORIZE
void CopyColumns(const int* starts, int num_nodes, const double* values, float scale,
                 float* out) {
  for (int j = 0; j < num_nodes; ++j) {
    const int count = starts[j + 1] - starts[j];
    const double* column = values + 9 * static_cast<size_t>(starts[j]);
    const int stride = 3 * count;
    for (int k = 0; k < count; ++k, column += 3, out += 9) {
      for (int c = 0; c < 3; ++c) {
        for (int r = 0; r < 3; ++r) {
          out[3 * c + r] = scale * static_cast<float>(column[r * stride + c]);
        }
      }
    }
  }
}

// `next` holds the starts of the rows and is used up.
DPE_VECTORIZE
void CopyRows(const int* starts, const int* rows, int num_nodes, const double* values,
              float scale, int* next, float* out) {
  for (int j = 0; j < num_nodes; ++j) {
    const int count = starts[j + 1] - starts[j];
    const double* column = values + 9 * static_cast<size_t>(starts[j]);
    const int stride = 3 * count;
    for (int k = 0; k < count; ++k, column += 3) {
      float* block = out + 9 * static_cast<size_t>(next[rows[starts[j] + k]]++);
      for (int c = 0; c < 3; ++c) {
        for (int r = 0; r < 3; ++r) {
          block[3 * c + r] = scale * static_cast<float>(column[c * stride + r]);
        }
      }
    }
  }
}

}  // namespace

void Multigrid::AddLevel(BlockRows matrix) {
  levels_.emplace_back();
  Level& level = levels_.back();
  level.matrix = std::move(matrix);
  const size_t n = 3 * static_cast<size_t>(level.matrix.num_nodes());
  level.r.resize(n);
  level.z.resize(n);
  level.residual.resize(n);
}

bool Multigrid::Compute(const BlockPattern& pattern, const double* values,
                        bool transposed) {
  if (levels_.empty()) {
    AddLevel(BlockRows(pattern.block_starts(), pattern.block_rows()));
  }
  BlockRows& finest = levels_[0].matrix;
  const double scale = Scale(pattern, finest.diagonal(), values);
  if (scale == 0.0) return false;
  if (transposed) {
    CopyColumns(pattern.block_starts().data(), pattern.num_nodes(), values,
                static_cast<float>(scale), finest.values());
  } else {
    next_ = pattern.block_starts();
    CopyRows(pattern.block_starts().data(), pattern.block_rows().data(),
             pattern.num_nodes(), values, static_cast<float>(scale), next_.data(),
             finest.values());
  }
  for (size_t l = 0;; ++l) {
    if (!levels_[l].matrix.InvertDiagonal()) return false;
    if (!built_ && levels_[l].matrix.num_nodes() > kDenseNodes && l < kMaxLevels) {
      Prolongation coarser(levels_[l].matrix);
      if (coarser.num_coarse() < kMaxRatio * levels_[l].matrix.num_nodes()) {
        BlockRows coarse = coarser.MakeCoarse();
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
  const BlockRows& a = levels_.back().matrix;
  dense_ = a.num_nodes() <= kDenseNodes;
  if (!dense_) return true;
  coarsest_.setZero(3 * a.num_nodes(), 3 * a.num_nodes());
  for (int i = 0; i < a.num_nodes(); ++i) {
    for (int k = a.starts()[i]; k < a.starts()[i + 1]; ++k) {
      coarsest_.block<3, 3>(3 * i, 3 * a.columns()[k]) =
          Eigen::Map<const Eigen::Matrix3f>(a.block(k));
    }
  }
  lu_.compute(coarsest_);
  return lu_.matrixLU().allFinite() &&
         lu_.matrixLU().diagonal().cwiseAbs().minCoeff() > 0.0f;
}

void Multigrid::Cycle(int l) {
  Level& level = levels_[l];
  if (level.coarser.empty() && dense_) {
    const Eigen::Index n = static_cast<Eigen::Index>(level.r.size());
    Eigen::Map<Eigen::VectorXf>(level.z.data(), n) =
        lu_.solve(Eigen::Map<const Eigen::VectorXf>(level.r.data(), n));
    return;
  }
  level.matrix.SweepForward(level.r.data(), level.z.data(), level.residual.data());
  if (!level.coarser.empty()) {
    Level& next = levels_[l + 1];
    level.coarser[0].Restrict(level.residual.data(), next.r.data());
    Cycle(l + 1);
    level.coarser[0].AddProlonged(next.z.data(), level.z.data());
  }
  level.matrix.SweepBackward(level.r.data(), level.z.data());
}

void Multigrid::Apply(const double* r, double factor, float* z) {
  Level& finest = levels_[0];
  const size_t n = finest.r.size();
  for (size_t c = 0; c < n; ++c) finest.r[c] = static_cast<float>(factor * r[c]);
  Cycle(0);
  std::copy(finest.z.begin(), finest.z.end(), z);
}

double Multigrid::complexity() const {
  double blocks = 0.0;
  for (const Level& level : levels_) blocks += level.matrix.num_blocks();
  return blocks / levels_[0].matrix.num_blocks();
}

}  // namespace dpe
