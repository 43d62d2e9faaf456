#include "linear/symbolic_analysis.h"

#include <cholmod.h>

#include <cstring>
#include <new>

namespace dpe {

std::shared_ptr<const SupernodalStructure> AnalyzePattern(const BlockPattern& pattern) {
  cholmod_common common;
  cholmod_start(&common);
  common.print = 0;
  common.supernodal = CHOLMOD_SUPERNODAL;
  common.nmethods = 1;
  common.method[0].ordering = CHOLMOD_NATURAL;
  common.postorder = 0;
  cholmod_sparse matrix;
  std::memset(&matrix, 0, sizeof(matrix));
  matrix.nrow = matrix.ncol = pattern.num_rows();
  matrix.nzmax = pattern.num_nonzeros();
  matrix.p = const_cast<int*>(pattern.column_starts().data());
  matrix.i = const_cast<int*>(pattern.row_indices().data());
  matrix.stype = -1;  // CHOLMOD ignores entries above the diagonal
  matrix.itype = CHOLMOD_INT;
  matrix.xtype = CHOLMOD_PATTERN;
  matrix.dtype = CHOLMOD_DOUBLE;
  matrix.sorted = 1;
  matrix.packed = 1;
  cholmod_factor* symbolic = cholmod_analyze(&matrix, &common);
  std::shared_ptr<const SupernodalStructure> structure;
  if (symbolic != nullptr) {
    structure = std::make_shared<SupernodalStructure>(pattern, *symbolic);
  }
  cholmod_free_factor(&symbolic, &common);
  cholmod_finish(&common);
  if (structure == nullptr) throw std::bad_alloc();
  return structure;
}

}  // namespace dpe
