// The vector operations of Krylov methods and derivative passes, on raw arrays and
// vectorised at run time.
#ifndef DPE_ENGINE_LINEAR_VECTOR_KERNELS_H_
#define DPE_ENGINE_LINEAR_VECTOR_KERNELS_H_

#include <cstddef>

namespace dpe {
// GCC shows functions of DPE_VECTORIZE in a shared library whatever is said of their
// visibility; by this namespace cmake/exports.map hides them.
inline namespace vectorized {

// x^T y.
double Dot(size_t n, const double* x, const double* y);
float Dot(size_t n, const float* x, const float* y);
// y += a x.
void AddScaled(size_t n, float a, const float* x, float* y);
void AddScaled(size_t n, double a, const float* x, double* y);
void AddScaled(size_t n, double a, const double* x, double* y);
// out := a x + b y; out may be x or y.
void Combine(size_t n, double a, const double* x, double b, const double* y,
             double* out);
// y := a x.
void Scale(size_t n, double a, const double* x, double* y);
void Scale(size_t n, float a, const float* x, float* y);
void Scale(size_t n, double a, const double* x, float* y);
// y := b - a y.
void SubtractScaled(size_t n, const double* b, double a, double* y);

}  // namespace vectorized
}  // namespace dpe

#endif  // DPE_ENGINE_LINEAR_VECTOR_KERNELS_H_
