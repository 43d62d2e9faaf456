// One cycle of GMRES (Saad & Schultz 1986) with a preconditioner P from the right:
//   minimise |r - A P^{-1} V y| over y,  z += P^{-1} V y,
// V an orthonormal basis of the Krylov space of A P^{-1} and r. Where P is nearly A a
// few iterations reach rounding level.
#ifndef DPE_ENGINE_LINEAR_GMRES_H_
#define DPE_ENGINE_LINEAR_GMRES_H_

#include <Eigen/Core>
#include <cmath>
#include <vector>

namespace dpe {

constexpr int kMaxGmresIterations = 30;

// @param residual      r = b - A z
// @param norm          its norm, > 0
// @param target        the norm of the residual at which to stop
// @param iterations    at most so many, up to kMaxGmresIterations
// @param multiply      multiply(x, y): y := A x
// @param precondition  precondition(x, y): y := P^{-1} x
// @param basis         workspace, resized as needed
// @return false if not one iteration was possible
template <class Multiply, class Precondition>
bool GmresCycle(int n, const double* residual, double norm, double target,
                int iterations, const Multiply& multiply,
                const Precondition& precondition, std::vector<double>* basis,
                double* z) {
  using Vector = Eigen::Map<Eigen::VectorXd>;
  constexpr int kMax = kMaxGmresIterations;
  basis->resize(static_cast<size_t>(2 * kMax + 1) * n);
  double hessenberg[kMax + 1][kMax];
  double cosine[kMax], sine[kMax], g[kMax + 1];
  const auto column = [&](int j) {
    return Vector(basis->data() + static_cast<size_t>(j) * n, n);
  };
  const auto preconditioned = [&](int j) { return column(kMax + 1 + j); };
  column(0) = Eigen::Map<const Eigen::VectorXd>(residual, n) / norm;
  g[0] = norm;
  int used = 0;
  for (int j = 0; j < iterations; ++j) {
    precondition(column(j).data(), preconditioned(j).data());
    multiply(preconditioned(j).data(), column(j + 1).data());
    for (int i = 0; i <= j; ++i) {
      hessenberg[i][j] = column(i).dot(column(j + 1));
      column(j + 1) -= hessenberg[i][j] * column(i);
    }
    const double height = column(j + 1).norm();
    for (int i = 0; i < j; ++i) {
      const double upper = hessenberg[i][j];
      hessenberg[i][j] = cosine[i] * upper + sine[i] * hessenberg[i + 1][j];
      hessenberg[i + 1][j] = cosine[i] * hessenberg[i + 1][j] - sine[i] * upper;
    }
    const double length = std::hypot(hessenberg[j][j], height);
    if (!(length > 0.0) || !std::isfinite(length)) break;
    cosine[j] = hessenberg[j][j] / length;
    sine[j] = height / length;
    hessenberg[j][j] = length;
    g[j + 1] = -sine[j] * g[j];
    g[j] *= cosine[j];
    used = j + 1;
    if (std::abs(g[j + 1]) <= target || height == 0.0) break;
    column(j + 1) /= height;
  }
  // z += P^{-1} V y with H y = g; P^{-1} V was kept, which saves an application of P.
  double y[kMax];
  for (int i = used - 1; i >= 0; --i) {
    y[i] = g[i];
    for (int k = i + 1; k < used; ++k) y[i] -= hessenberg[i][k] * y[k];
    y[i] /= hessenberg[i][i];
  }
  for (int i = 0; i < used; ++i) Vector(z, n) += y[i] * preconditioned(i);
  return used > 0;
}

}  // namespace dpe

#endif  // DPE_ENGINE_LINEAR_GMRES_H_
