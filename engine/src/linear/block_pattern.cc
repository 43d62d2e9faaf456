#include "linear/block_pattern.h"

#include <algorithm>

#include "linear/vectorize.h"

namespace dpe {
namespace {

// Three numbers as a pair and a single one: what fits a block without reading past it.
typedef double Pair __attribute__((vector_size(16)));
struct Triple {
  Pair pair;
  double single;
};

DPE_ALWAYS_INLINE Triple Load(const double* from) {
  Triple a;
  __builtin_memcpy(&a.pair, from, sizeof(Pair));
  a.single = from[2];
  return a;
}

DPE_ALWAYS_INLINE void Store(const Triple& a, double* to) {
  __builtin_memcpy(to, &a.pair, sizeof(Pair));
  to[2] = a.single;
}

DPE_ALWAYS_INLINE double Sum(const Triple& a) {
  return a.pair[0] + a.pair[1] + a.single;
}

// sum += a b, entry by entry.
DPE_ALWAYS_INLINE void AddProduct(const Triple& a, const Triple& b, Triple* sum) {
  sum->pair += a.pair * b.pair;
  sum->single += a.single * b.single;
}

// y += A x.
DPE_VECTORIZE
void AddColumns(int num_nodes, const int* starts, const int* rows, const double* values,
                const double* x, double* y) {
  for (int j = 0; j < num_nodes; ++j) {
    const long stride = 3L * (starts[j + 1] - starts[j]);
    const double x0 = x[3 * j], x1 = x[3 * j + 1], x2 = x[3 * j + 2];
    const Triple t0{{x0, x0}, x0}, t1{{x1, x1}, x1}, t2{{x2, x2}, x2};
    const double* column = values + 9L * starts[j];
    for (int k = starts[j]; k < starts[j + 1]; ++k, column += 3) {
      double* out = y + 3L * rows[k];
      Triple sum = Load(out);
      AddProduct(Load(column), t0, &sum);
      AddProduct(Load(column + stride), t1, &sum);
      AddProduct(Load(column + 2 * stride), t2, &sum);
      Store(sum, out);
    }
  }
}

// y = A^T x.
DPE_VECTORIZE
void DotColumns(int num_nodes, const int* starts, const int* rows, const double* values,
                const double* x, double* y) {
  for (int j = 0; j < num_nodes; ++j) {
    const long stride = 3L * (starts[j + 1] - starts[j]);
    const double* column = values + 9L * starts[j];
    Triple sums[2][3] =
        {};  // of even and odd blocks, which need not wait for each other
    int k = starts[j];
    for (; k + 1 < starts[j + 1]; k += 2, column += 6) {
      const Triple even = Load(x + 3L * rows[k]), odd = Load(x + 3L * rows[k + 1]);
      for (int c = 0; c < 3; ++c) {
        AddProduct(Load(column + c * stride), even, &sums[0][c]);
        AddProduct(Load(column + c * stride + 3), odd, &sums[1][c]);
      }
    }
    if (k < starts[j + 1]) {
      const Triple last = Load(x + 3L * rows[k]);
      for (int c = 0; c < 3; ++c) {
        AddProduct(Load(column + c * stride), last, &sums[0][c]);
      }
    }
    for (int c = 0; c < 3; ++c) y[3 * j + c] = Sum(sums[0][c]) + Sum(sums[1][c]);
  }
}

}  // namespace

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
  AddColumns(num_nodes_, block_starts_.data(), block_rows_.data(), values, x, y);
}

void BlockPattern::MultiplyTransposed(const double* values, const double* x,
                                      double* y) const {
  DotColumns(num_nodes_, block_starts_.data(), block_rows_.data(), values, x, y);
}

}  // namespace dpe
