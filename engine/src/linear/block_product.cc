#include "linear/block_product.h"

#include <cstddef>

#include "linear/vectorize.h"

namespace dpe {
namespace {

// Column by column: y += A_.j x_j.
DPE_VECTORIZE
void Product(const int* starts, const int* rows, int num_nodes, const double* values,
             const double* __restrict x, double* __restrict y) {
  for (int c = 0; c < 3 * num_nodes; ++c) y[c] = 0.0;
  for (int j = 0; j < num_nodes; ++j) {
    const int count = starts[j + 1] - starts[j];
    const int stride = 3 * count;
    const double* column = values + 9 * static_cast<size_t>(starts[j]);
    const double x0 = x[3 * j], x1 = x[3 * j + 1], x2 = x[3 * j + 2];
    for (int k = 0; k < count; ++k, column += 3) {
      double* out = y + 3 * rows[starts[j] + k];
      for (int r = 0; r < 3; ++r) {
        out[r] +=
            column[r] * x0 + column[stride + r] * x1 + column[2 * stride + r] * x2;
      }
    }
  }
}

// y_j = A_.j^T x, in three sums per column that do not wait for each other.
DPE_VECTORIZE
void ProductTransposed(const int* starts, const int* rows, int num_nodes,
                       const double* values, const double* __restrict x,
                       double* __restrict y) {
  for (int j = 0; j < num_nodes; ++j) {
    const int count = starts[j + 1] - starts[j];
    const int stride = 3 * count;
    const double* column = values + 9 * static_cast<size_t>(starts[j]);
    double sums[3][3] = {};
    for (int k = 0; k < count; ++k, column += 3) {
      const double* in = x + 3 * rows[starts[j] + k];
      for (int c = 0; c < 3; ++c) {
        for (int r = 0; r < 3; ++r) sums[c][r] += column[c * stride + r] * in[r];
      }
    }
    for (int c = 0; c < 3; ++c) y[3 * j + c] = sums[c][0] + sums[c][1] + sums[c][2];
  }
}

}  // namespace

void BlockProduct(const BlockPattern& pattern, const double* values, const double* x,
                  double* y) {
  Product(pattern.block_starts().data(), pattern.block_rows().data(),
          pattern.num_nodes(), values, x, y);
}

void BlockProductTransposed(const BlockPattern& pattern, const double* values,
                            const double* x, double* y) {
  ProductTransposed(pattern.block_starts().data(), pattern.block_rows().data(),
                    pattern.num_nodes(), values, x, y);
}

}  // namespace dpe
