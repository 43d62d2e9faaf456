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

class SingleRows {
 public:
  // What kernels read of a matrix.
  struct Rows {
    int num_nodes;
    const int* lower_starts;
    const int* upper_starts;
    const int* columns;  // by place
    const float* values;
    const float* inverses;
  };

  SingleRows() = default;
  // @param starts, columns  row i has its blocks in columns[k], starts[i] <= k <
  //                         starts[i + 1], sorted; the diagonal must be among them
  SingleRows(std::vector<int> starts, std::vector<int> columns);

  int num_nodes() const { return static_cast<int>(diagonal_.size()); }
  int num_blocks() const { return static_cast<int>(columns_.size()); }
  const std::vector<int>& starts() const { return starts_; }
  const std::vector<int>& columns() const { return columns_; }
  // Where the diagonal block of each row is among its columns.
  const std::vector<int>& diagonal() const { return diagonal_; }

  // Nine numbers per block, column by column. Blocks are in the order L, D, U, each by
  // rows, so that a sweep over one of them reads nothing else: block `k` of row `i` is
  // at place(i, k).
  float* values() { return values_.data(); }
  const float* values() const { return values_.data(); }
  int place(int i, int k) const {
    if (k < diagonal_[i]) return lower_starts_[i] + k - starts_[i];
    if (k == diagonal_[i]) return lower_starts_[num_nodes()] + i;
    return upper_starts_[i] + k - diagonal_[i] - 1;
  }
  const float* block(int i, int k) const {
    return values_.data() + 9 * static_cast<size_t>(place(i, k));
  }
  const std::vector<int>& lower_starts() const { return lower_starts_; }
  const std::vector<int>& upper_starts() const { return upper_starts_; }
  Rows rows() const;
  void SetZero();

  // Inverts the diagonal blocks, which the sweeps need. False if one is singular or not
  // finite.
  bool InvertDiagonal();

  // y := A x; x and y must not overlap.
  void Multiply(const float* x, float* y) const;
  // z := (L + D)^{-1} r, and residual := -U z, which is r - A z.
  void SweepForward(const float* r, float* z, float* residual) const;
  // z := (D + U)^{-1} (r - L z).
  void SweepBackward(const float* r, float* z) const;

 private:
  std::vector<int> starts_, columns_, diagonal_;
  // Where the rows of L and U start among the blocks.
  std::vector<int> lower_starts_, upper_starts_;
  std::vector<int> block_columns_;  // by place
  std::vector<float> values_;
  std::vector<float> inverses_;  // per node three columns of four numbers
};

}  // namespace dpe

#endif  // DPE_ENGINE_LINEAR_BLOCK_ROWS_H_
