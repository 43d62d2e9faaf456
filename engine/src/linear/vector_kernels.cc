#include "linear/vector_kernels.h"

#include "linear/vectorize.h"

namespace dpe {

DPE_VECTORIZE
double Dot(size_t n, const double* x, const double* y) {
  constexpr int kLanes = 16;  // independent sums, which a compiler may vectorise
  double sums[kLanes] = {};
  size_t i = 0;
  for (; i + kLanes <= n; i += kLanes) {
    for (int l = 0; l < kLanes; ++l) sums[l] += x[i + l] * y[i + l];
  }
  for (int l = 0; i < n; ++i, ++l) sums[l] += x[i] * y[i];
  for (int half = kLanes / 2; half > 0; half /= 2) {
    for (int l = 0; l < half; ++l) sums[l] += sums[l + half];
  }
  return sums[0];
}

DPE_VECTORIZE
void AddScaled(size_t n, double a, const double* __restrict x, double* __restrict y) {
  for (size_t i = 0; i < n; ++i) y[i] += a * x[i];
}

DPE_VECTORIZE
void AddScaled(size_t n, double a, const float* __restrict x, double* __restrict y) {
  for (size_t i = 0; i < n; ++i) y[i] += a * static_cast<double>(x[i]);
}

DPE_VECTORIZE
void Scale(size_t n, double a, double* x) {
  for (size_t i = 0; i < n; ++i) x[i] *= a;
}

DPE_VECTORIZE
void SubtractFrom(size_t n, const double* __restrict b, double* __restrict y) {
  for (size_t i = 0; i < n; ++i) y[i] = b[i] - y[i];
}

}  // namespace dpe
