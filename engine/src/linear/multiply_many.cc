#include "linear/multiply_many.h"

#include <algorithm>

#include "linear/vector_kernels.h"
#include "linear/vectorize.h"

namespace dpe {
namespace {

// out_r += sum_c block[r][c] in_c, for the three rows of one block.
DPE_VECTORIZE
void AddOneBlock(const double* __restrict block, const double* __restrict in,
                 long count, double* __restrict out) {
  const double b0 = block[0], b1 = block[1], b2 = block[2];
  const double b3 = block[3], b4 = block[4], b5 = block[5];
  const double b6 = block[6], b7 = block[7], b8 = block[8];
  for (long k = 0; k < count; ++k) {
    const double x = in[k], y = in[count + k], z = in[2 * count + k];
    out[k] += b0 * x + b1 * y + b2 * z;
    out[count + k] += b3 * x + b4 * y + b5 * z;
    out[2 * count + k] += b6 * x + b7 * y + b8 * z;
  }
}

// The same for two blocks at once, which halves the traffic of `out`: with 18
// coefficients, 6 inputs and 3 sums it fits into 32 registers.
DPE_VECTORIZE
void AddTwoBlocks(const double* __restrict block, const double* __restrict in,
                  const double* __restrict in2, long count, double* __restrict out) {
  const double a0 = block[0], a1 = block[1], a2 = block[2];
  const double a3 = block[3], a4 = block[4], a5 = block[5];
  const double a6 = block[6], a7 = block[7], a8 = block[8];
  const double b0 = block[9], b1 = block[10], b2 = block[11];
  const double b3 = block[12], b4 = block[13], b5 = block[14];
  const double b6 = block[15], b7 = block[16], b8 = block[17];
  for (long k = 0; k < count; ++k) {
    const double x = in[k], y = in[count + k], z = in[2 * count + k];
    const double u = in2[k], v = in2[count + k], w = in2[2 * count + k];
    out[k] += a0 * x + a1 * y + a2 * z + b0 * u + b1 * v + b2 * w;
    out[count + k] += a3 * x + a4 * y + a5 * z + b3 * u + b4 * v + b5 * w;
    out[2 * count + k] += a6 * x + a7 * y + a8 * z + b6 * u + b7 * v + b8 * w;
  }
}

}  // namespace

void BlockRows::Assign(const BlockPattern& pattern, const double* values,
                       bool transposed) {
  const std::vector<int>& block_starts = pattern.block_starts();
  const auto for_each_block = [&](auto&& visit) {
    for (int j = 0; j < pattern.num_nodes(); ++j) {
      const int stride = 3 * (block_starts[j + 1] - block_starts[j]);
      for (int k = block_starts[j]; k < block_starts[j + 1]; ++k) {
        const double* entry = values + 9L * block_starts[j] + 3 * (k - block_starts[j]);
        double block[9], sum = 0.0;
        for (int c = 0; c < 3; ++c) {
          for (int r = 0; r < 3; ++r) {
            const double value = entry[c * stride + r];
            block[transposed ? 3 * c + r : 3 * r + c] = value;
            sum += value != 0.0 ? 1.0 : 0.0;  // also for what is not a number
          }
        }
        const int i = pattern.block_rows()[k];
        if (sum > 0.0) visit(transposed ? j : i, transposed ? i : j, block);
      }
    }
  };
  starts_.assign(pattern.num_nodes() + 1, 0);
  for_each_block([&](int row, int, const double*) { ++starts_[row + 1]; });
  for (int i = 0; i < pattern.num_nodes(); ++i) starts_[i + 1] += starts_[i];
  next_.assign(starts_.begin(), starts_.end() - 1);
  columns_.resize(starts_.back());
  blocks_.resize(9 * columns_.size());
  for_each_block([&](int row, int column, const double* block) {
    const int k = next_[row]++;
    columns_[k] = column;
    std::copy_n(block, 9, blocks_.begin() + 9L * k);
  });
}

void BlockRows::Multiply(const double* in, int count, double scale, const double* base,
                         double* out) const {
  const long stride = 3L * count;
  for (size_t i = 0; i + 1 < starts_.size(); ++i) {
    double* row = out + i * stride;
    if (base == nullptr) {
      std::fill_n(row, stride, 0.0);
    } else if (base != out || scale != 1.0) {
      Combine(stride, scale, base + i * stride, 0.0, base + i * stride, row);
    }
    int k = starts_[i];
    for (; k + 1 < starts_[i + 1]; k += 2) {
      AddTwoBlocks(blocks_.data() + 9L * k, in + columns_[k] * stride,
                   in + columns_[k + 1] * stride, count, row);
    }
    if (k < starts_[i + 1]) {
      AddOneBlock(blocks_.data() + 9L * k, in + columns_[k] * stride, count, row);
    }
  }
}

}  // namespace dpe
