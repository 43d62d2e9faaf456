// The vector operations of Krylov methods, on raw arrays and vectorised at run time.
#ifndef DPE_ENGINE_LINEAR_VECTOR_KERNELS_H_
#define DPE_ENGINE_LINEAR_VECTOR_KERNELS_H_

#include <cstddef>

namespace dpe {

// x^T y.
double Dot(size_t n, const double* x, const double* y);
// y += a x.
void AddScaled(size_t n, double a, const double* x, double* y);
void AddScaled(size_t n, double a, const float* x, double* y);
// x *= a.
void Scale(size_t n, double a, double* x);
// y := b - y.
void SubtractFrom(size_t n, const double* b, double* y);

}  // namespace dpe

#endif  // DPE_ENGINE_LINEAR_VECTOR_KERNELS_H_
