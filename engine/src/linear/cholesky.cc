#include "linear/cholesky.h"

#include <algorithm>
#include <cstring>
#include <new>

#include "linear/serial_openmp.h"
#include "linear/supernodal_solve.h"

namespace dpe {

Cholesky::Cholesky(const BlockPattern& pattern) : pattern_(pattern) {
  cholmod_start(&common_);
  common_.print = 0;
  common_.supernodal = CHOLMOD_SUPERNODAL;
  common_.nmethods = 1;  // the pattern comes in a fill-reducing order
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
  factor_ = cholmod_analyze(&matrix_, &common_);
  if (factor_ == nullptr) throw std::bad_alloc();
  matrix_.xtype = CHOLMOD_REAL;
}

Cholesky::~Cholesky() {
  cholmod_free_factor(&factor_, &common_);
  cholmod_finish(&common_);
}

bool Cholesky::Factorize(const double* values) {
  matrix_.x = const_cast<double*>(values);
  common_.status = CHOLMOD_OK;
  const SerialOpenmp serial;
  cholmod_factorize(&matrix_, factor_, &common_);
  return common_.status == CHOLMOD_OK && factor_->minor == factor_->n;
}

void Cholesky::Solve(const double* b, double* x) {
  SupernodalFactor factor;
  factor.num_supernodes = static_cast<int>(factor_->nsuper);
  factor.first_column = static_cast<const int*>(factor_->super);
  factor.row_start = static_cast<const int*>(factor_->pi);
  factor.value_start = static_cast<const int*>(factor_->px);
  factor.row_indices = static_cast<const int*>(factor_->s);
  factor.values = static_cast<const double*>(factor_->x);
  if (b != x) std::copy_n(b, pattern_.num_rows(), x);
  SolveSupernodal(factor, &work_, x);
}

}  // namespace dpe
