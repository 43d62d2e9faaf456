#include "prior_rows.h"

#include <algorithm>
#include <cmath>

#include "prior_targets.h"
#include "tall_qr.h"

namespace dpe {
namespace {

// As a dense matrix a piece has this many rows and its block's columns.
constexpr int kRowsPerPiece = 256;

}  // namespace

double PriorRows::Row::Residual(const double* q, int offset) const {
  const double value = is_exponential ? std::exp(q[a - offset]) : q[a - offset];
  return scale * (value - (b >= 0 ? q[b - offset] : 0.0) - centre);
}

double PriorRows::Row::Slope(const double* q, int offset) const {
  return is_exponential ? scale * std::exp(q[a - offset]) : scale;
}

PriorRows::PriorRows(const Scene& scene, const ParameterLayout& layout,
                     const std::vector<Prior>& priors,
                     const std::vector<SmoothnessPrior>& smoothness) {
  std::vector<std::vector<Row>> of_block(layout.blocks().size());
  for (const Prior& prior : priors) {
    AddValueRows(scene, layout, prior, &of_block);
  }
  for (const SmoothnessPrior& one : smoothness) {
    AddDifferenceRows(scene, layout, one, &of_block);
  }
  for (int block = 0; block < static_cast<int>(of_block.size()); ++block) {
    const int count = static_cast<int>(of_block[block].size());
    for (int k = 0; k < count; k += kRowsPerPiece) {
      const int begin = size() + k;
      pieces_.push_back({block, begin, begin + std::min(kRowsPerPiece, count - k)});
    }
    rows_.insert(rows_.end(), of_block[block].begin(), of_block[block].end());
  }
}

double PriorRows::Cost(const Eigen::VectorXd& q) const {
  double sum = 0.0;
  for (const Row& row : rows_) {
    const double r = row.Residual(q.data(), 0);
    sum += r * r;
  }
  return 0.5 * sum;
}

void PriorRows::AddGradient(const Eigen::VectorXd& q, Eigen::VectorXd* gradient) const {
  for (const Row& row : rows_) {
    const double r = row.Residual(q.data(), 0);
    (*gradient)[row.a] += r * row.Slope(q.data(), 0);
    if (row.b >= 0) (*gradient)[row.b] -= r * row.scale;
  }
}

Eigen::MatrixXd PriorRows::Triangle(const Eigen::VectorXd& q, int num_threads) const {
  const int n = static_cast<int>(q.size());
  const auto fill = [&](int begin, Eigen::Ref<Eigen::MatrixXd> out) {
    out.setZero();
    for (int i = 0; i < out.rows(); ++i) {
      const Row& row = rows_[begin + i];
      out(i, row.a) = row.Slope(q.data(), 0);
      if (row.b >= 0) out(i, row.b) -= row.scale;
    }
    return true;
  };
  Eigen::MatrixXd result;
  if (size() <= n) {
    result.resize(size(), n);
    fill(0, result);
    return result;
  }
  TallQr(
      ChunkRows(size()), n, num_threads,
      [&](int chunk, Eigen::Ref<Eigen::MatrixXd> out) {
        return fill(chunk * kRowsPerChunk, out);
      },
      &result);
  return result;
}

}  // namespace dpe
