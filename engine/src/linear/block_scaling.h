// The norm of residuals in the unit of the unknowns: with D_i the 3x3 diagonal block of
// node i, |r|_D^2 = sum_i |D_i^{-1} r_i|^2.
//
// D_i^{-1} r_i is by how much node i alone would have to change for its equations to
// hold, whatever their size. The plain norm weighs equations by their size: a vertex on
// a stiff collider has rows of h^2 K beside those of its free neighbours, which are m,
// and where h^2 K / m = 1e5 a residual of 1e-6 of b's norm leaves the neighbours' rows
// up to 10 % off. The plain norm in turn is right where unknowns and not equations
// differ in size, as in transposed systems: A^T has those columns for rows.
#ifndef DPE_ENGINE_LINEAR_BLOCK_SCALING_H_
#define DPE_ENGINE_LINEAR_BLOCK_SCALING_H_

#include <vector>

#include "linear/block_pattern.h"

namespace dpe {

class BlockScaling {
 public:
  explicit BlockScaling(const BlockPattern& pattern);

  // Takes D from A in the pattern, or from A^T if `transposed`.
  // @return false if a block is singular or not finite
  bool Compute(const double* values, bool transposed);

  // |r|_D, r of length 3 nodes.
  double Norm(const double* r) const;

 private:
  std::vector<BlockSlot> diagonal_;
  std::vector<double> inverses_;  // per node nine numbers, column by column
};

}  // namespace dpe

#endif  // DPE_ENGINE_LINEAR_BLOCK_SCALING_H_
