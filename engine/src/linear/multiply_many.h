// Sparse times dense products on many columns at once: the inner loop of tangent and
// block adjoint passes.
#ifndef DPE_ENGINE_LINEAR_MULTIPLY_MANY_H_
#define DPE_ENGINE_LINEAR_MULTIPLY_MANY_H_

#include <vector>

#include "linear/block_pattern.h"

namespace dpe {

// The 3x3 blocks of a matrix A, or of A^T, that are not zero, row by row: what a
// product reads in its order, however many times. Force terms that a scene does not
// have leave whole matrices of zeros but for the diagonal.
class BlockRows {
 public:
  // Takes the blocks of `values`, which are in this pattern.
  void Assign(const BlockPattern& pattern, const double* values, bool transposed);

  // out = A in + scale * base; all arrays are row-major n x count.
  //
  // @param base  null: nothing is added; may be `out`
  // @param out   must not overlap `in`
  void Multiply(const double* in, int count, double scale, const double* base,
                double* out) const;

 private:
  std::vector<int> starts_;     // blocks of row i: [starts_[i], starts_[i + 1])
  std::vector<int> columns_;    // of each block
  std::vector<double> blocks_;  // 9 each, row-major
  std::vector<int> next_;       // scratch of Assign
};

}  // namespace dpe

#endif  // DPE_ENGINE_LINEAR_MULTIPLY_MANY_H_
