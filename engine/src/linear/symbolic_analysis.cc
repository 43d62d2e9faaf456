#include "linear/symbolic_analysis.h"

#include <cstring>
#include <new>

namespace dpe {

SymbolicAnalysis::SymbolicAnalysis(const BlockPattern& pattern) {
  cholmod_start(&common_);
  common_.print = 0;
  common_.supernodal = CHOLMOD_SUPERNODAL;
  common_.nmethods = 1;
  common_.method[0].ordering = CHOLMOD_NATURAL;
  common_.postorder = 0;
  common_.final_ll = 1;  // L L^T: a negative pivot is a failure, not a factor
  std::memset(&matrix_, 0, sizeof(matrix_));
  matrix_.nrow = matrix_.ncol = pattern.num_rows();
  matrix_.nzmax = pattern.num_nonzeros();
  matrix_.p = const_cast<int*>(pattern.column_starts().data());
  matrix_.i = const_cast<int*>(pattern.row_indices().data());
  matrix_.stype = -1;  // CHOLMOD ignores entries above the diagonal
  matrix_.itype = CHOLMOD_INT;
  matrix_.xtype = CHOLMOD_PATTERN;
  matrix_.dtype = CHOLMOD_DOUBLE;
  matrix_.sorted = 1;
  matrix_.packed = 1;
  symbolic_ = cholmod_analyze(&matrix_, &common_);
  if (symbolic_ == nullptr) throw std::bad_alloc();
  matrix_.xtype = CHOLMOD_REAL;
  structure_ = std::make_shared<SupernodalStructure>(pattern, *symbolic_);
}

SymbolicAnalysis::~SymbolicAnalysis() {
  cholmod_free_factor(&symbolic_, &common_);
  cholmod_finish(&common_);
}

}  // namespace dpe
