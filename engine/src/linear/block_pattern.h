// The sparsity of a step's linear system: 3x3 blocks between coupled free vertices,
// stored as a compressed-column matrix that CHOLMOD and LAPACK-style code read as is.
// It is computed once per scene; assembly afterwards only writes values.
#ifndef DPE_ENGINE_LINEAR_BLOCK_PATTERN_H_
#define DPE_ENGINE_LINEAR_BLOCK_PATTERN_H_

#include <Eigen/Core>
#include <array>
#include <utility>
#include <vector>

namespace dpe {

// Where a 3x3 block lives in the value array: entry (r, c) at offset + c * stride + r.
// offset < 0 marks a block that is not part of the system (a fixed vertex).
struct BlockSlot {
  int offset = -1;
  int stride = 0;
};

class BlockPattern {
 public:
  BlockPattern() = default;
  // @param num_nodes  number of free vertices
  // @param couplings  pairs of nodes (any order, repeats allowed); the diagonal is
  //                   always present and the pattern is made symmetric
  BlockPattern(int num_nodes, const std::vector<std::pair<int, int>>& couplings);

  int num_nodes() const { return num_nodes_; }
  int num_rows() const { return 3 * num_nodes_; }
  int num_nonzeros() const { return 9 * static_cast<int>(block_rows_.size()); }

  // Scalar compressed columns, rows sorted.
  const std::vector<int>& column_starts() const { return column_starts_; }
  const std::vector<int>& row_indices() const { return row_indices_; }
  // For each scalar entry (r, c), the index of entry (c, r).
  const std::vector<int>& transposed_index() const { return transposed_index_; }

  // Block columns: rows block_rows()[k] for k in [block_starts()[j], [j + 1]).
  const std::vector<int>& block_starts() const { return block_starts_; }
  const std::vector<int>& block_rows() const { return block_rows_; }

  // The slot of block (row, col); both must be coupled nodes, or -1 for no block.
  BlockSlot Find(int row_node, int col_node) const;

  // y = A x, or y = A^T x, for values in this pattern.
  void Multiply(const double* values, const double* x, double* y) const;
  void MultiplyTransposed(const double* values, const double* x, double* y) const;
  void Multiply(const double* values, bool transposed, const double* x,
                double* y) const {
    transposed ? MultiplyTransposed(values, x, y) : Multiply(values, x, y);
  }

 private:
  void BuildScalarColumns();

  int num_nodes_ = 0;
  std::vector<int> block_starts_, block_rows_;
  std::vector<int> column_starts_, row_indices_, transposed_index_;
};

// values[slot] += block.
inline void AddBlock(const BlockSlot& slot, const Eigen::Matrix3d& block,
                     double* values) {
  if (slot.offset < 0) return;
  for (int c = 0; c < 3; ++c) {
    double* column = values + slot.offset + c * slot.stride;
    column[0] += block(0, c);
    column[1] += block(1, c);
    column[2] += block(2, c);
  }
}

}  // namespace dpe

#endif  // DPE_ENGINE_LINEAR_BLOCK_PATTERN_H_
