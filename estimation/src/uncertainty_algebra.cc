#include "uncertainty_algebra.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <vector>

extern "C" {
// Singular value decomposition by divide and conquer. LAPACK has no header of its own
// that every distribution installs.
void dgesdd_(const char* jobz, const int* m, const int* n, double* a, const int* lda,
             double* s, double* u, const int* ldu, double* vt, const int* ldvt,
             double* work, const int* lwork, int* iwork, int* info);
}

namespace dpe {
namespace {

// A column is zero below this part of the rank tolerance, relative to the longest:
// short columns are legitimate (a spring far from every marker).
constexpr double kZeroColumn = 1e-3;

// Orthonormal basis of the columns of `a`, which are linearly independent.
Eigen::MatrixXd Orthonormalised(const Eigen::MatrixXd& a) {
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(a);
  return qr.householderQ() * Eigen::MatrixXd::Identity(a.rows(), a.cols());
}

// Rows of V^T that belong to singular values of zero. Where A has fewer rows than
// columns V^T lacks some of them.
Eigen::MatrixXd NullVectors(const Eigen::MatrixXd& vt, int rank) {
  const int num_missing = static_cast<int>(vt.cols() - vt.rows());
  if (num_missing == 0) return vt.bottomRows(vt.rows() - rank).transpose();
  return Complement(vt.topRows(rank).transpose());
}

}  // namespace

bool Svd(Eigen::MatrixXd* a, Eigen::VectorXd* s, Eigen::MatrixXd* vt) {
  const int m = static_cast<int>(a->rows());
  const int n = static_cast<int>(a->cols());
  const int k = std::min(m, n);
  s->resize(k);
  vt->resize(k, n);
  if (k == 0) return true;
  Eigen::MatrixXd u(m, k);
  std::vector<int> iwork(8 * static_cast<size_t>(k));
  int info = 0;
  int lwork = -1;
  double size = 0.0;
  dgesdd_("S", &m, &n, a->data(), &m, s->data(), u.data(), &m, vt->data(), &k, &size,
          &lwork, iwork.data(), &info);
  lwork = static_cast<int>(size);
  std::vector<double> work(lwork);
  dgesdd_("S", &m, &n, a->data(), &m, s->data(), u.data(), &m, vt->data(), &k,
          work.data(), &lwork, iwork.data(), &info);
  return info == 0;
}

Eigen::MatrixXd Complement(const Eigen::MatrixXd& y) {
  const int n = static_cast<int>(y.rows());
  const int num_rest = n - static_cast<int>(y.cols());
  Eigen::MatrixXd rest = Eigen::MatrixXd::Zero(n, num_rest);
  rest.bottomRows(num_rest).setIdentity();
  if (y.cols() == 0) return rest;
  return Eigen::HouseholderQR<Eigen::MatrixXd>(y).householderQ() * rest;
}

InformationAnalysis AnalyseInformation(const Eigen::MatrixXd& a, double tolerance) {
  InformationAnalysis result;
  const int n = static_cast<int>(a.cols());
  const Eigen::VectorXd length =
      a.rows() > 0 ? a.colwise().norm().transpose().eval() : Eigen::VectorXd::Zero(n);
  const double shortest = kZeroColumn * tolerance * length.maxCoeff();
  std::vector<int> used, zero;
  for (int j = 0; j < n; ++j) (length[j] > shortest ? used : zero).push_back(j);

  // B: the columns in use, of unit length.
  const int num_used = static_cast<int>(used.size());
  Eigen::MatrixXd b(a.rows(), num_used);
  for (int k = 0; k < num_used; ++k) b.col(k) = a.col(used[k]) / length[used[k]];
  Eigen::VectorXd s;
  Eigen::MatrixXd vt;
  if (!Svd(&b, &s, &vt)) return result;
  while (result.rank < s.size() && s[result.rank] > tolerance * s[0]) ++result.rank;

  // V^T D, of the determined part and of the null space.
  const Eigen::MatrixXd null = NullVectors(vt, result.rank);
  const int num_null = static_cast<int>(null.cols());
  Eigen::MatrixXd null_z = Eigen::MatrixXd::Zero(n, num_null + zero.size());
  result.root.setZero(result.rank, n);
  for (int k = 0; k < num_used; ++k) {
    const double d = 1.0 / length[used[k]];
    result.root.col(used[k]) =
        d * vt.col(k).head(result.rank).cwiseQuotient(s.head(result.rank));
    // Scaled up: lengths of columns may lie near the ends of the range of numbers.
    null_z.row(used[k]).head(num_null) = d * null.row(k);
  }
  null_z.leftCols(num_null).colwise().normalize();
  for (size_t k = 0; k < zero.size(); ++k) null_z(zero[k], num_null + k) = 1.0;
  result.null_basis = Orthonormalised(null_z);
  if (result.null_basis.cols() > 0) {
    result.root -= (result.root * result.null_basis) * result.null_basis.transpose();
  }
  result.ok = true;
  return result;
}

bool WeakSubspace(const InformationAnalysis& analysis, double threshold,
                  Eigen::MatrixXd* basis) {
  basis->resize(analysis.root.cols(), 0);
  // No singular value exceeds the Frobenius norm.
  if (!(analysis.root.norm() > threshold)) return true;
  Eigen::MatrixXd root = analysis.root;
  Eigen::VectorXd s;
  Eigen::MatrixXd vt;
  if (!Svd(&root, &s, &vt)) return false;
  int num_weak = 0;
  while (num_weak < s.size() && s[num_weak] > threshold) ++num_weak;
  *basis = vt.topRows(num_weak).transpose();
  return true;
}

}  // namespace dpe
