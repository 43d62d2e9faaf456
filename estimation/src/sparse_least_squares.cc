#include "sparse_least_squares.h"

#include <SuiteSparseQR.hpp>
#include <algorithm>
#include <cmath>

namespace dpe {
namespace {

// Shorter than this beside the longest column is zero but for rounding.
constexpr double kZeroColumn = 1e-15;

using LongSparseMatrix = Eigen::SparseMatrix<double, Eigen::ColMajor, SuiteSparse_long>;

// A view of `matrix`, which must be compressed.
cholmod_sparse ViewSparse(LongSparseMatrix* matrix) {
  cholmod_sparse view = {};
  view.nrow = matrix->rows();
  view.ncol = matrix->cols();
  view.nzmax = matrix->nonZeros();
  view.p = matrix->outerIndexPtr();
  view.i = matrix->innerIndexPtr();
  view.x = matrix->valuePtr();
  view.stype = 0;
  view.itype = CHOLMOD_LONG;
  view.xtype = CHOLMOD_REAL;
  view.dtype = CHOLMOD_DOUBLE;
  view.sorted = 1;
  view.packed = 1;
  return view;
}

cholmod_dense ViewDense(Eigen::VectorXd* vector) {
  cholmod_dense view = {};
  view.nrow = vector->size();
  view.ncol = 1;
  view.nzmax = vector->size();
  view.d = vector->size();
  view.x = vector->data();
  view.xtype = CHOLMOD_REAL;
  view.dtype = CHOLMOD_DOUBLE;
  return view;
}

Eigen::VectorXd ColumnLengths(const Eigen::SparseMatrix<double>& matrix) {
  Eigen::VectorXd lengths(matrix.cols());
  for (int j = 0; j < matrix.cols(); ++j) lengths[j] = matrix.col(j).norm();
  return lengths;
}

}  // namespace

struct SparseLeastSquares::Factor {
  Factor() { cholmod_l_start(&common); }
  ~Factor() {
    if (qr != nullptr) SuiteSparseQR_free(&qr, &common);
    cholmod_l_finish(&common);
  }
  Factor(const Factor&) = delete;
  Factor& operator=(const Factor&) = delete;

  cholmod_common common;
  SuiteSparseQR_factorization<double>* qr = nullptr;
};

SparseLeastSquares::SparseLeastSquares(const Eigen::SparseMatrix<double>& matrix,
                                       double rank_tolerance)
    : is_dead_(matrix.cols(), 1), factor_(std::make_unique<Factor>()) {
  const Eigen::VectorXd lengths = ColumnLengths(matrix);
  const double longest = lengths.size() > 0 ? lengths.maxCoeff() : 0.0;
  for (int j = 0; j < matrix.cols(); ++j) {
    if (lengths[j] > kZeroColumn * longest) kept_columns_.push_back(j);
  }
  const int num_kept = static_cast<int>(kept_columns_.size());
  if (num_kept == 0) {
    ok_ = true;
    return;
  }
  scale_.resize(num_kept);
  LongSparseMatrix scaled(matrix.rows(), num_kept);
  scaled.reserve(matrix.nonZeros());
  for (int k = 0; k < num_kept; ++k) {
    const int j = kept_columns_[k];
    scale_[k] = 1.0 / lengths[j];
    scaled.startVec(k);
    for (Eigen::SparseMatrix<double>::InnerIterator it(matrix, j); it; ++it) {
      scaled.insertBack(it.row(), k) = it.value() * scale_[k];
    }
  }
  scaled.finalize();
  cholmod_sparse view = ViewSparse(&scaled);
  factor_->qr = SuiteSparseQR_factorize<double>(SPQR_ORDERING_DEFAULT, rank_tolerance,
                                                &view, &factor_->common);
  if (factor_->qr == nullptr) return;
  ok_ = true;
  for (int column : kept_columns_) is_dead_[column] = 0;
  const SuiteSparseQR_factorization<double>& qr = *factor_->qr;
  if (qr.Rmap == nullptr) return;  // full rank
  for (int k = 0; k < num_kept; ++k) {
    if (qr.Rmap[k] < qr.rank) continue;
    const SuiteSparse_long column = qr.Q1fill != nullptr ? qr.Q1fill[k] : k;
    is_dead_[kept_columns_[column]] = 1;
  }
}

SparseLeastSquares::~SparseLeastSquares() = default;

int SparseLeastSquares::num_dead() const {
  return static_cast<int>(std::count(is_dead_.begin(), is_dead_.end(), 1));
}

Eigen::VectorXd SparseLeastSquares::Solve(const Eigen::VectorXd& rhs) const {
  Eigen::VectorXd solution = Eigen::VectorXd::Zero(is_dead_.size());
  if (factor_->qr == nullptr) return solution;
  Eigen::VectorXd rhs_copy = rhs;
  cholmod_dense view = ViewDense(&rhs_copy);
  cholmod_common* common = &factor_->common;
  cholmod_dense* rotated =
      SuiteSparseQR_qmult<double>(SPQR_QTX, factor_->qr, &view, common);
  cholmod_dense* scaled =
      SuiteSparseQR_solve<double>(SPQR_RETX_EQUALS_B, factor_->qr, rotated, common);
  if (scaled != nullptr) {
    const double* values = static_cast<const double*>(scaled->x);
    for (size_t k = 0; k < kept_columns_.size(); ++k) {
      solution[kept_columns_[k]] = values[k] * scale_[k];
    }
  }
  cholmod_l_free_dense(&rotated, common);
  cholmod_l_free_dense(&scaled, common);
  return solution;
}

}  // namespace dpe
