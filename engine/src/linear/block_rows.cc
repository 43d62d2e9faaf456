#include "linear/block_rows.h"

#include <Eigen/LU>
#include <algorithm>
#include <utility>

#include "linear/float4.h"
#include "linear/vectorize.h"

namespace dpe {
namespace {

// Of four numbers the fourth belongs to a block's next column and is carried along
// unused.
constexpr int kPadding = 4;  // a load of the last column reads one number past the end

// sum - A_i,first..last x for the blocks `first` to `last` of one row.
inline Float4 Subtract(const float* values, const int* columns, int first, int last,
                       const float* x, Float4 sum) {
  Float4 s1 = {}, s2 = {};
  const float* block = values + 9 * static_cast<size_t>(first);
  for (int k = first; k < last; ++k, block += 9) {
    const float* in = x + 3 * columns[k];
    sum -= LoadFour(block) * in[0];
    s1 += LoadFour(block + 3) * in[1];
    s2 += LoadFour(block + 6) * in[2];
  }
  return sum - (s1 + s2);
}

inline void Store(Float4 v, float* out) {
  out[0] = v[0];
  out[1] = v[1];
  out[2] = v[2];
}

inline Float4 Load(const float* in) { return Float4{in[0], in[1], in[2], 0.0f}; }

inline void StoreSolution(const float* inverse, Float4 v, float* out) {
  Store(LoadFour(inverse) * v[0] + LoadFour(inverse + 4) * v[1] +
            LoadFour(inverse + 8) * v[2],
        out);
}

using Rows = SingleRows::Rows;

DPE_VECTORIZE
void Forward(Rows a, const float* r, float* z) {
  for (int i = 0; i < a.num_nodes; ++i) {
    StoreSolution(a.inverses + 12 * static_cast<size_t>(i),
                  Subtract(a.values, a.columns, a.lower_starts[i],
                           a.lower_starts[i + 1], z, Load(r + 3 * i)),
                  z + 3 * i);
  }
}

DPE_VECTORIZE
void MinusUpper(Rows a, const float* z, float* residual) {
  for (int i = 0; i < a.num_nodes; ++i) {
    Store(Subtract(a.values, a.columns, a.upper_starts[i], a.upper_starts[i + 1], z,
                   Float4{}),
          residual + 3 * i);
  }
}

DPE_VECTORIZE
void Backward(Rows a, const float* r, float* z) {
  for (int i = a.num_nodes - 1; i >= 0; --i) {
    Float4 sum = Load(r + 3 * i);
    sum =
        Subtract(a.values, a.columns, a.lower_starts[i], a.lower_starts[i + 1], z, sum);
    sum =
        Subtract(a.values, a.columns, a.upper_starts[i], a.upper_starts[i + 1], z, sum);
    StoreSolution(a.inverses + 12 * static_cast<size_t>(i), sum, z + 3 * i);
  }
}

DPE_VECTORIZE
void Product(Rows a, const float* x, float* y) {
  const int first_diagonal = a.lower_starts[a.num_nodes];
  for (int i = 0; i < a.num_nodes; ++i) {
    Float4 sum = Subtract(a.values, a.columns, a.lower_starts[i], a.lower_starts[i + 1],
                          x, Float4{});
    sum = Subtract(a.values, a.columns, first_diagonal + i, first_diagonal + i + 1, x,
                   sum);
    sum =
        Subtract(a.values, a.columns, a.upper_starts[i], a.upper_starts[i + 1], x, sum);
    Store(-sum, y + 3 * i);
  }
}

}  // namespace

SingleRows::SingleRows(std::vector<int> starts, std::vector<int> columns)
    : starts_(std::move(starts)), columns_(std::move(columns)) {
  const int n = static_cast<int>(starts_.size()) - 1;
  lower_starts_.push_back(0);
  for (int i = 0; i < n; ++i) {
    const auto first = columns_.begin() + starts_[i];
    const auto last = columns_.begin() + starts_[i + 1];
    diagonal_.push_back(
        static_cast<int>(std::lower_bound(first, last, i) - columns_.begin()));
    lower_starts_.push_back(lower_starts_[i] + diagonal_[i] - starts_[i]);
  }
  upper_starts_.push_back(lower_starts_[n] + n);
  for (int i = 0; i < n; ++i) {
    upper_starts_.push_back(upper_starts_[i] + starts_[i + 1] - diagonal_[i] - 1);
  }
  block_columns_.resize(columns_.size());
  for (int i = 0; i < n; ++i) {
    for (int k = starts_[i]; k < starts_[i + 1]; ++k) {
      block_columns_[place(i, k)] = columns_[k];
    }
  }
  values_.resize(9 * columns_.size() + kPadding);
  inverses_.resize(12 * static_cast<size_t>(n));
}

void SingleRows::SetZero() { std::fill(values_.begin(), values_.end(), 0.0f); }

bool SingleRows::InvertDiagonal() {
  using Block = Eigen::Matrix3f;
  for (int i = 0; i < num_nodes(); ++i) {
    const Block inverse = Eigen::Map<const Block>(block(i, diagonal_[i])).inverse();
    if (!inverse.allFinite()) return false;
    Eigen::Map<Eigen::Matrix<float, 4, 3>>(inverses_.data() +
                                           12 * static_cast<size_t>(i))
        .topRows<3>() = inverse;
  }
  return true;
}

void SingleRows::Multiply(const float* x, float* y) const { Product(rows(), x, y); }

void SingleRows::SweepForward(const float* r, float* z, float* residual) const {
  Forward(rows(), r, z);
  MinusUpper(rows(), z, residual);
}

void SingleRows::SweepBackward(const float* r, float* z) const {
  Backward(rows(), r, z);
}

SingleRows::Rows SingleRows::rows() const {
  return {num_nodes(),           lower_starts_.data(), upper_starts_.data(),
          block_columns_.data(), values_.data(),       inverses_.data()};
}

}  // namespace dpe
