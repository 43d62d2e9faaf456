// Sparse times dense products on many columns at once: the inner loop of tangent and
// block adjoint passes.
#ifndef DPE_ENGINE_LINEAR_MULTIPLY_MANY_H_
#define DPE_ENGINE_LINEAR_MULTIPLY_MANY_H_

#include "linear/block_pattern.h"

namespace dpe {

// out += A in, or out += A^T in if `transposed`; in and out are row-major n x count and
// must not overlap.
void AddMultiplyMany(const BlockPattern& pattern, const double* values, bool transposed,
                     const double* in, int count, double* out);

}  // namespace dpe

#endif  // DPE_ENGINE_LINEAR_MULTIPLY_MANY_H_
