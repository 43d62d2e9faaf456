// Products of a BlockPattern's matrix with one vector, vectorised at run time.
#ifndef DPE_ENGINE_LINEAR_BLOCK_PRODUCT_H_
#define DPE_ENGINE_LINEAR_BLOCK_PRODUCT_H_

#include "linear/block_pattern.h"

namespace dpe {

// y := A x, and y := A^T x; x and y must not overlap.
void BlockProduct(const BlockPattern& pattern, const double* values, const double* x,
                  double* y);
void BlockProductTransposed(const BlockPattern& pattern, const double* values,
                            const double* x, double* y);

}  // namespace dpe

#endif  // DPE_ENGINE_LINEAR_BLOCK_PRODUCT_H_
