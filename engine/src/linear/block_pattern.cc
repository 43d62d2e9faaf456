#include "linear/block_pattern.h"

#include <algorithm>

namespace dpe {

BlockPattern::BlockPattern(int num_nodes,
                           const std::vector<std::pair<int, int>>& couplings)
    : num_nodes_(num_nodes) {
  std::vector<std::pair<int, int>> entries;  // (column, row)
  entries.reserve(2 * couplings.size() + num_nodes);
  for (int i = 0; i < num_nodes; ++i) entries.emplace_back(i, i);
  for (const auto& [a, b] : couplings) {
    if (a < 0 || b < 0) continue;
    entries.emplace_back(a, b);
    entries.emplace_back(b, a);
  }
  std::sort(entries.begin(), entries.end());
  entries.erase(std::unique(entries.begin(), entries.end()), entries.end());
  block_starts_.assign(num_nodes + 1, 0);
  block_rows_.reserve(entries.size());
  for (const auto& [column, row] : entries) {
    ++block_starts_[column + 1];
    block_rows_.push_back(row);
  }
  for (int j = 0; j < num_nodes; ++j) block_starts_[j + 1] += block_starts_[j];
  BuildScalarColumns();
}

void BlockPattern::BuildScalarColumns() {
  column_starts_.reserve(num_rows() + 1);
  row_indices_.reserve(num_nonzeros());
  column_starts_.push_back(0);
  for (int j = 0; j < num_nodes_; ++j) {
    for (int c = 0; c < 3; ++c) {
      for (int k = block_starts_[j]; k < block_starts_[j + 1]; ++k) {
        for (int r = 0; r < 3; ++r) row_indices_.push_back(3 * block_rows_[k] + r);
      }
      column_starts_.push_back(static_cast<int>(row_indices_.size()));
    }
  }
  transposed_index_.resize(num_nonzeros());
  for (int j = 0; j < num_nodes_; ++j) {
    for (int k = block_starts_[j]; k < block_starts_[j + 1]; ++k) {
      const BlockSlot slot = Find(block_rows_[k], j);
      const BlockSlot mirror = Find(j, block_rows_[k]);
      for (int c = 0; c < 3; ++c) {
        for (int r = 0; r < 3; ++r) {
          transposed_index_[slot.offset + c * slot.stride + r] =
              mirror.offset + r * mirror.stride + c;
        }
      }
    }
  }
}

BlockSlot BlockPattern::Find(int row_node, int col_node) const {
  if (row_node < 0 || col_node < 0) return {};
  const auto first = block_rows_.begin() + block_starts_[col_node];
  const auto last = block_rows_.begin() + block_starts_[col_node + 1];
  const auto it = std::lower_bound(first, last, row_node);
  if (it == last || *it != row_node) return {};
  BlockSlot slot;
  slot.offset = 9 * block_starts_[col_node] + 3 * static_cast<int>(it - first);
  slot.stride = 3 * (block_starts_[col_node + 1] - block_starts_[col_node]);
  return slot;
}

void BlockPattern::Multiply(const double* values, const double* x, double* y) const {
  std::fill(y, y + num_rows(), 0.0);
  for (int j = 0; j < num_nodes_; ++j) {
    const int count = block_starts_[j + 1] - block_starts_[j];
    const int* rows = block_rows_.data() + block_starts_[j];
    const double* column = values + 9 * block_starts_[j];
    const int stride = 3 * count;
    const double x0 = x[3 * j], x1 = x[3 * j + 1], x2 = x[3 * j + 2];
    for (int k = 0; k < count; ++k, column += 3) {
      double* out = y + 3 * rows[k];
      for (int r = 0; r < 3; ++r) {
        out[r] +=
            column[r] * x0 + column[stride + r] * x1 + column[2 * stride + r] * x2;
      }
    }
  }
}

void BlockPattern::MultiplyTransposed(const double* values, const double* x,
                                      double* y) const {
  for (int j = 0; j < num_nodes_; ++j) {
    const int count = block_starts_[j + 1] - block_starts_[j];
    const int* rows = block_rows_.data() + block_starts_[j];
    for (int c = 0; c < 3; ++c) {
      const double* column = values + 9 * block_starts_[j] + 3 * count * c;
      double sum = 0.0;
      for (int k = 0; k < count; ++k) {
        const double* in = x + 3 * rows[k];
        sum += column[3 * k] * in[0] + column[3 * k + 1] * in[1] +
               column[3 * k + 2] * in[2];
      }
      y[3 * j + c] = sum;
    }
  }
}

}  // namespace dpe
