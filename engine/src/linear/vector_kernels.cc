#include "linear/vector_kernels.h"

#include "linear/vectorize.h"

namespace dpe {
namespace {

template <typename T>
inline T DotInLanes(size_t n, const T* x, const T* y) {
  constexpr int kLanes = 32;  // independent sums, which a compiler may vectorise
  T sums[kLanes] = {};
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

}  // namespace

inline namespace vectorized {

DPE_VECTORIZE
double Dot(size_t n, const double* x, const double* y) { return DotInLanes(n, x, y); }

DPE_VECTORIZE
float Dot(size_t n, const float* x, const float* y) { return DotInLanes(n, x, y); }

DPE_VECTORIZE
void AddScaled(size_t n, float a, const float* __restrict x, float* __restrict y) {
  for (size_t i = 0; i < n; ++i) y[i] += a * x[i];
}

DPE_VECTORIZE
void AddScaled(size_t n, double a, const float* __restrict x, double* __restrict y) {
  for (size_t i = 0; i < n; ++i) y[i] += a * static_cast<double>(x[i]);
}

DPE_VECTORIZE
void AddScaled(size_t n, double a, const double* x, double* y) {
#pragma omp simd
  for (size_t i = 0; i < n; ++i) y[i] += a * x[i];
}

DPE_VECTORIZE
void Combine(size_t n, double a, const double* x, double b, const double* y,
             double* out) {
#pragma omp simd
  for (size_t i = 0; i < n; ++i) out[i] = a * x[i] + b * y[i];
}

DPE_VECTORIZE
void Scale(size_t n, double a, const double* x, double* y) {
  for (size_t i = 0; i < n; ++i) y[i] = a * x[i];
}

DPE_VECTORIZE
void Scale(size_t n, float a, const float* x, float* y) {
  for (size_t i = 0; i < n; ++i) y[i] = a * x[i];
}

DPE_VECTORIZE
void Scale(size_t n, double a, const double* __restrict x, float* __restrict y) {
  for (size_t i = 0; i < n; ++i) y[i] = static_cast<float>(a * x[i]);
}

DPE_VECTORIZE
void SubtractScaled(size_t n, const double* __restrict b, double a,
                    double* __restrict y) {
  for (size_t i = 0; i < n; ++i) y[i] = b[i] - a * y[i];
}

}  // namespace vectorized
}  // namespace dpe
