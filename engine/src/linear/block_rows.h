// A square matrix of 3x3 blocks stored by block rows, in single precision, and the
// sweeps of block Gauss-Seidel over it: the inner loops of the multigrid
// preconditioner. With A = L + D + U (strictly lower, diagonal and strictly upper
// blocks),
//   forward from zero   (L + D) z = r, which leaves the residual r - A z = -U z,
//   backward            (D + U) z' = r - L z.
// Single precision is enough for a preconditioner and halves the memory that a sweep
// has to read, which is what it spends its time on.
#ifndef DPE_ENGINE_LINEAR_BLOCK_ROWS_H_
#define DPE_ENGINE_LINEAR_BLOCK_ROWS_H_

#include <cstddef>
#include <vector>

namespace dpe {

class BlockRows {
 public:
  BlockRows() = default;
  // @param starts, columns  row i has its blocks in columns[k], starts[i] <= k <
  //                         starts[i + 1], sorted; the diagonal must be among them
  BlockRows(std::vector<int> starts, std::vector<int> columns);

  int num_nodes() const { return static_cast<int>(diagonal_.size()); }
  int num_blocks() const { return static_cast<int>(columns_.size()); }
  const std::vector<int>& starts() const { return starts_; }
  const std::vector<int>& columns() const { return columns_; }
  // Where the diagonal block of each row is.
  const std::vector<int>& diagonal() const { return diagonal_; }

  // Nine numbers per block, column by column.
  float* values() { return values_.data(); }
  const float* values() const { return values_.data(); }
  const float* block(int k) const {
    return values_.data() + 9 * static_cast<size_t>(k);
  }
  void SetZero();

  // Inverts the diagonal blocks, which the sweeps need. False if one is singular or not
  // finite.
  bool InvertDiagonal();

  // z := (L + D)^{-1} r, and residual := -U z, which is r - A z.
  void SweepForward(const float* r, float* z, float* residual) const;
  // z := (D + U)^{-1} (r - L z).
  void SweepBackward(const float* r, float* z) const;

 private:
  std::vector<int> starts_, columns_, diagonal_;
  std::vector<float> values_;
  std::vector<float> inverses_;  // per node three columns of four numbers
};

}  // namespace dpe

#endif  // DPE_ENGINE_LINEAR_BLOCK_ROWS_H_
