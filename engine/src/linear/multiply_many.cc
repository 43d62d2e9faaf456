#include "linear/multiply_many.h"

#include "linear/vectorize.h"

namespace dpe {
namespace {

// out_r += sum_c block[r][c] in_c for rows of `count` numbers.
DPE_VECTORIZE
void AddBlockRows(const double (&block)[3][3], const double* __restrict in, int count,
                  double* __restrict out) {
  const double* in0 = in;
  const double* in1 = in + count;
  const double* in2 = in + 2 * count;
  for (int r = 0; r < 3; ++r) {
    double* __restrict row = out + r * count;
    const double a = block[r][0], b = block[r][1], c = block[r][2];
    for (int k = 0; k < count; ++k) row[k] += a * in0[k] + b * in1[k] + c * in2[k];
  }
}

}  // namespace

void AddMultiplyMany(const BlockPattern& pattern, const double* values, bool transposed,
                     const double* in, int count, double* out) {
  const std::vector<int>& starts = pattern.block_starts();
  double block[3][3];
  for (int j = 0; j < pattern.num_nodes(); ++j) {
    const int stride = 3 * (starts[j + 1] - starts[j]);
    for (int k = starts[j]; k < starts[j + 1]; ++k) {
      const double* entry = values + 9 * starts[j] + 3 * (k - starts[j]);
      for (int r = 0; r < 3; ++r) {
        for (int c = 0; c < 3; ++c) {
          (transposed ? block[c][r] : block[r][c]) = entry[c * stride + r];
        }
      }
      const long row = 3L * (transposed ? j : pattern.block_rows()[k]) * count;
      const long column = 3L * (transposed ? pattern.block_rows()[k] : j) * count;
      AddBlockRows(block, in + column, count, out + row);
    }
  }
}

}  // namespace dpe
