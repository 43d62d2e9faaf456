#include "linear/block_scaling.h"

#include <Eigen/LU>
#include <cmath>

#include "linear/vectorize.h"

namespace dpe {
namespace {

DPE_VECTORIZE
double SquaredNorm(size_t num_nodes, const double* inverses, const double* r) {
  double sum = 0.0;
  for (size_t i = 0; i < num_nodes; ++i, inverses += 9, r += 3) {
    for (int k = 0; k < 3; ++k) {
      const double z =
          inverses[k] * r[0] + inverses[3 + k] * r[1] + inverses[6 + k] * r[2];
      sum += z * z;
    }
  }
  return sum;
}

}  // namespace

BlockScaling::BlockScaling(const BlockPattern& pattern) {
  for (int i = 0; i < pattern.num_nodes(); ++i) diagonal_.push_back(pattern.Find(i, i));
  inverses_.resize(9 * diagonal_.size());
}

bool BlockScaling::Compute(const double* values, bool transposed) {
  double* inverse = inverses_.data();
  for (const BlockSlot& slot : diagonal_) {
    const Eigen::Map<const Eigen::Matrix3d, 0, Eigen::OuterStride<>> block(
        values + slot.offset, Eigen::OuterStride<>(slot.stride));
    Eigen::Map<Eigen::Matrix3d> out(inverse);
    out = block.inverse();
    if (transposed) out.transposeInPlace();
    if (!out.allFinite()) return false;
    inverse += 9;
  }
  return true;
}

double BlockScaling::Norm(const double* r) const {
  return std::sqrt(SquaredNorm(diagonal_.size(), inverses_.data(), r));
}

}  // namespace dpe
