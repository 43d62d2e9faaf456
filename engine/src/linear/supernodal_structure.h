// The structure of a supernodal factorisation of a matrix in a BlockPattern, computed
// once per scene: which columns are factorised together (supernodes, found by CHOLMOD),
// and where the matrix's blocks and the updates of earlier supernodes go.
//
// Supernode s has the columns [first_column[s], first_column[s + 1]) and the rows
// rows[row_start[s]] ... rows[row_start[s + 1] - 1], its own columns first. Its
// *panels* are dense column-major arrays: that of L, rows x columns at value_start[s],
// which has its own part of U above the diagonal, and that of U^T, with the rows below
// alone, at upper_start[s]; factors of symmetric matrices do without the latter. The
// rows below its own columns are updated by it; the updates are gathered in a square
// *remainder* and added to the parent: the supernode of the first such row
// (multifrontal method, Duff & Reid 1983; Liu 1992).
//
// The three unknowns of a node are coupled to the same nodes, so they are always in one
// supernode, and rows come in threes.
#ifndef DPE_ENGINE_LINEAR_SUPERNODAL_STRUCTURE_H_
#define DPE_ENGINE_LINEAR_SUPERNODAL_STRUCTURE_H_

#include <cholmod.h>

#include <cstddef>
#include <vector>

#include "linear/block_pattern.h"

namespace dpe {

struct SupernodalStructure {
  // The blocks (i, j) and (j, i), i >= j, of the matrix, and which of the rows and
  // columns of j's supernode they belong to.
  struct BlockPair {
    BlockSlot lower, upper;
    int row, column;
  };

  // Consecutive rows that are consecutive among the parent's rows too.
  struct Run {
    int first;  // among the rows below the own columns of s, from 0
    int place;  // of `first` among the parent's rows
    int length;
  };

  // @param symbolic  CHOLMOD's supernodal analysis of the pattern, in natural order
  SupernodalStructure(const BlockPattern& pattern, const cholmod_factor& symbolic);

  int num_columns(int s) const { return first_column[s + 1] - first_column[s]; }
  int num_rows(int s) const { return row_start[s + 1] - row_start[s]; }
  int num_below(int s) const { return num_rows(s) - num_columns(s); }
  // Of all panels of L, of U^T, and those that the factors of a matrix have.
  size_t num_lower_values() const { return value_start.back(); }
  size_t num_upper_values() const { return upper_start.back(); }
  size_t num_values(bool symmetric) const {
    return num_lower_values() + (symmetric ? 0 : num_upper_values());
  }

  int num_supernodes = 0;
  int max_columns = 0;  // of a supernode
  std::vector<int> first_column, row_start, rows;
  std::vector<size_t> value_start, upper_start;

  // The tree; -1 where there is none.
  std::vector<int> first_child, next_sibling;
  // The rows below the own columns of supernode s, as runs of rows that are consecutive
  // among the parent's rows too: those of s are [run_start[s], run_start[s + 1]). No
  // run crosses the border between the parent's own columns and the rows below.
  std::vector<int> run_start;
  std::vector<Run> runs;
  // Where a remainder lives in a workspace; those that are in use at the same time do
  // not overlap.
  std::vector<size_t> remainder_start;
  size_t workspace_size = 0;

  std::vector<int> pair_start;  // pairs of supernode s: [pair_start[s], [s + 1])
  std::vector<BlockPair> pairs;

 private:
  void FindTree();
  void AppendRuns(int s, int parent);
  void PlaceRemainders();
  void ListPairs(const BlockPattern& pattern);
};

}  // namespace dpe

#endif  // DPE_ENGINE_LINEAR_SUPERNODAL_STRUCTURE_H_
