#include "linear/cholesky.h"

#include <cstring>
#include <new>
#include <utility>

#include "linear/serial_openmp.h"

namespace dpe {

CholeskyAnalysis::CholeskyAnalysis(const BlockPattern& pattern) {
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

CholeskyAnalysis::~CholeskyAnalysis() {
  cholmod_free_factor(&symbolic_, &common_);
  cholmod_finish(&common_);
}

Cholesky::Cholesky(std::shared_ptr<CholeskyAnalysis> analysis)
    : analysis_(std::move(analysis)) {
  factor_ = cholmod_copy_factor(analysis_->symbolic_, &analysis_->common_);
  if (factor_ == nullptr) throw std::bad_alloc();
}

Cholesky::~Cholesky() { cholmod_free_factor(&factor_, &analysis_->common_); }

bool Cholesky::Factorize(const double* values) {
  cholmod_common* common = &analysis_->common_;
  analysis_->matrix_.x = const_cast<double*>(values);
  common->status = CHOLMOD_OK;
  const SerialOpenmp serial;
  cholmod_factorize(&analysis_->matrix_, factor_, common);
  return common->status == CHOLMOD_OK && factor_->minor == factor_->n;
}

SupernodalFactor Cholesky::factor() const {
  SupernodalFactor factor;
  const SupernodalStructure& structure = *analysis_->structure_;
  factor.num_supernodes = structure.num_supernodes;
  factor.first_column = structure.first_column.data();
  factor.row_start = structure.row_start.data();
  factor.row_indices = structure.rows.data();
  factor.value_start = structure.value_start.data();
  factor.lower = factor.upper = static_cast<const double*>(factor_->x);
  return factor;
}

}  // namespace dpe
