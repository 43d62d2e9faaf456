// Between one lane of a batch and the arrays of an object.
#ifndef DPE_ENGINE_FORCES_LANE_SCATTER_H_
#define DPE_ENGINE_FORCES_LANE_SCATTER_H_

#include <array>
#include <cstddef>

#include "forces/element_batch.h"
#include "linear/block_pattern.h"

namespace dpe {

// Factors of a Jacobian's parts: cx dphi/dx + cv (dphi/dv - (1 - plain) df/dv).
struct JacobianFactors {
  double cx, cv;
  double plain;
};

// sum_j weights[j] x[rows[j] .. rows[j] + 2].
template <size_t kCount>
DPE_ALWAYS_INLINE Vec3 WeightedSum(const double (&weights)[kCount], const double* x,
                                   const std::array<int, kCount>& rows) {
  Vec3 sum{0.0, 0.0, 0.0};
  bool is_first = true;
  for (size_t j = 0; j < kCount; ++j) {
    if (weights[j] == 0.0) continue;
    const double* xj = x + rows[j];
    const Vec3 term = weights[j] * Vec3{xj[0], xj[1], xj[2]};
    sum = is_first ? term : sum + term;
    is_first = false;
  }
  return sum;
}

// out += factor * a.
DPE_ALWAYS_INLINE void AddVec3(double factor, Vec3 a, double* out) {
  out[0] += factor * a.x;
  out[1] += factor * a.y;
  out[2] += factor * a.z;
}

// values[slots[r]] += factors[r] * the lane's matrix, for the blocks of one column.
template <int kCount>
DPE_ALWAYS_INLINE void AddLaneBlocks(const MatrixLanes& matrices, int lane,
                                     const double (&factors)[kCount],
                                     const BlockSlot* slots, double* values) {
  const Vec3 x = matrices.x.Get(lane);
  const Vec3 y = matrices.y.Get(lane);
  const Vec3 z = matrices.z.Get(lane);
  for (int r = 0; r < kCount; ++r) {
    if (slots[r].offset < 0) continue;
    double* column = values + slots[r].offset;
    AddVec3(factors[r], x, column);
    AddVec3(factors[r], y, column + slots[r].stride);
    AddVec3(factors[r], z, column + 2 * slots[r].stride);
  }
}

}  // namespace dpe

#endif  // DPE_ENGINE_FORCES_LANE_SCATTER_H_
