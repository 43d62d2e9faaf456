// The linear algebra of uncertainty: null space, covariance and weak directions of an
// information matrix A^T A, without forming it. Derived in uncertainty.h.
#ifndef DPE_ESTIMATION_UNCERTAINTY_ALGEBRA_H_
#define DPE_ESTIMATION_UNCERTAINTY_ALGEBRA_H_

#include <Eigen/Core>

namespace dpe {

struct InformationAnalysis {
  bool ok = false;  // false: LAPACK did not converge
  int rank = 0;
  Eigen::MatrixXd null_basis;  // n x (n - rank), orthonormal columns
  // L, rank x n: L^T L is the pseudo-inverse of A^T A.
  Eigen::MatrixXd root;

  // The standard deviation of a linear form c^T z of the determined part.
  double Deviation(const Eigen::VectorXd& c) const { return (root * c).norm(); }
};

// @param a          rows x n, any number of rows, finite
// @param tolerance  singular values of A with unit columns below this, relative to the
//                   largest, count as zero; columns below `tolerance` times 1e-3 of the
//                   longest likewise
InformationAnalysis AnalyseInformation(const Eigen::MatrixXd& a, double tolerance);

// Orthonormal directions in which the determined part's standard deviation exceeds
// `threshold`, n x k, greatest first. False if LAPACK did not converge.
bool WeakSubspace(const InformationAnalysis& analysis, double threshold,
                  Eigen::MatrixXd* basis);

// a = U diag(s) V^T with as many singular values as `a` has rows or columns, whichever
// are fewer, greatest first. Overwrites `a`. False if LAPACK did not converge.
bool Svd(Eigen::MatrixXd* a, Eigen::VectorXd* s, Eigen::MatrixXd* vt);

// The last columns of Q in the QR decomposition of `y`: an orthonormal basis of the
// complement of y's columns, which must be linearly independent.
Eigen::MatrixXd Complement(const Eigen::MatrixXd& y);

}  // namespace dpe

#endif  // DPE_ESTIMATION_UNCERTAINTY_ALGEBRA_H_
