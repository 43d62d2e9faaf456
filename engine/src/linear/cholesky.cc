#include "linear/cholesky.h"

#include <cmath>
#include <cstring>
#include <new>

#include "linear/serial_openmp.h"

namespace dpe {

Cholesky::Cholesky(const BlockPattern& pattern) : pattern_(pattern) {
  cholmod_start(&common_);
  common_.print = 0;
  common_.supernodal = CHOLMOD_SUPERNODAL;
  common_.nmethods = 1;  // nested dissection, the best of CHOLMOD's on cloth grids
  common_.method[0].ordering = CHOLMOD_NESDIS;
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
  cholmod_free_dense(&solution_, &common_);
  cholmod_free_dense(&work_y_, &common_);
  cholmod_free_dense(&work_e_, &common_);
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
  if (b != x) std::memcpy(x, b, sizeof(double) * pattern_.num_rows());
  SolveMany(x, 1);
}

void Cholesky::SolveMany(double* columns, int count) {
  cholmod_dense right;
  std::memset(&right, 0, sizeof(right));
  right.nrow = right.d = pattern_.num_rows();
  right.ncol = count;
  right.nzmax = right.nrow * count;
  right.x = columns;
  right.xtype = CHOLMOD_REAL;
  right.dtype = CHOLMOD_DOUBLE;
  cholmod_solve2(CHOLMOD_A, factor_, &right, nullptr, &solution_, nullptr, &work_y_,
                 &work_e_, &common_);
  std::memcpy(columns, solution_->x, sizeof(double) * right.nzmax);
}

}  // namespace dpe
