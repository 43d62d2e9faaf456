#include "linear/iterative_solver.h"

#include <Eigen/LU>
#include <cmath>

namespace dpe {
namespace {

using ConstVector = Eigen::Map<const Eigen::VectorXd>;
using Vector = Eigen::Map<Eigen::VectorXd>;

// A cloth's step needs a few dozen; beyond this a factorisation is the better way.
constexpr int kMaxIterations = 1000;

class Krylov {
 public:
  Krylov(const BlockPattern& pattern, const std::vector<double>& values,
         const BlockJacobi& preconditioner, bool transposed, IterativeWorkspace* work)
      : n_(pattern.num_rows()),
        pattern_(pattern),
        values_(values),
        preconditioner_(preconditioner),
        transposed_(transposed),
        work_(*work) {
    for (auto* v : {&work_.r, &work_.p, &work_.q, &work_.s, &work_.t, &work_.shadow,
                    &work_.preconditioned}) {
      v->resize(n_);
    }
  }

  IterativeResult ConjugateGradients(const double* b, double tolerance, double* z) {
    Vector r = In(&work_.r), p = In(&work_.p), q = In(&work_.q), m = In(&work_.s);
    const double target = tolerance * ConstVector(b, n_).norm();
    IterativeResult result;
    StartResidual(b, z);
    double rho = 0.0;
    for (; result.iterations < kMaxIterations; ++result.iterations) {
      const double norm = r.norm();
      result.converged = norm <= target;
      if (result.converged || !std::isfinite(norm)) return result;
      Precondition(r, &m);
      const double rho_before = rho;
      rho = r.dot(m);
      if (result.iterations == 0) {
        p = m;
      } else {
        p = m + (rho / rho_before) * p;
      }
      Multiply(p, &q);
      const double curvature = p.dot(q);
      if (!(curvature > 0.0) || !(rho > 0.0)) return result;  // not positive definite
      Vector(z, n_) += (rho / curvature) * p;
      r -= (rho / curvature) * q;
    }
    return result;
  }

  IterativeResult BiCgStab(const double* b, double tolerance, double* z) {
    Vector r = In(&work_.r), p = In(&work_.p), v = In(&work_.q), s = In(&work_.s);
    Vector t = In(&work_.t), shadow = In(&work_.shadow), m = In(&work_.preconditioned);
    const double target = tolerance * ConstVector(b, n_).norm();
    IterativeResult result;
    StartResidual(b, z);
    shadow = r;
    double rho = 1.0, alpha = 1.0, omega = 1.0;
    p.setZero();
    v.setZero();
    for (; result.iterations < kMaxIterations; ++result.iterations) {
      const double norm = r.norm();
      result.converged = norm <= target;
      if (result.converged || !std::isfinite(norm)) return result;
      const double rho_before = rho;
      rho = shadow.dot(r);
      if (rho == 0.0 || omega == 0.0) return result;  // breakdown
      p = r + (rho / rho_before) * (alpha / omega) * (p - omega * v);
      Precondition(p, &m);
      Multiply(m, &v);
      alpha = rho / shadow.dot(v);
      Vector(z, n_) += alpha * m;
      s = r - alpha * v;
      Precondition(s, &m);
      Multiply(m, &t);
      const double tt = t.squaredNorm();
      omega = tt > 0.0 ? t.dot(s) / tt : 0.0;
      Vector(z, n_) += omega * m;
      r = s - omega * t;
    }
    return result;
  }

 private:
  Vector In(std::vector<double>* v) const { return Vector(v->data(), n_); }

  void Multiply(const Vector& x, Vector* y) const {
    if (transposed_) {
      pattern_.MultiplyTransposed(values_.data(), x.data(), y->data());
    } else {
      pattern_.Multiply(values_.data(), x.data(), y->data());
    }
  }

  void Precondition(const Vector& x, Vector* y) const {
    preconditioner_.Apply(x.data(), y->data(), transposed_);
  }

  // r := b - A z.
  void StartResidual(const double* b, const double* z) {
    Vector r = In(&work_.r), q = In(&work_.q);
    if (ConstVector(z, n_).isZero(0.0)) {
      r = ConstVector(b, n_);
      return;
    }
    if (transposed_) {
      pattern_.MultiplyTransposed(values_.data(), z, q.data());
    } else {
      pattern_.Multiply(values_.data(), z, q.data());
    }
    r = ConstVector(b, n_) - q;
  }

  int n_;
  const BlockPattern& pattern_;
  const std::vector<double>& values_;
  const BlockJacobi& preconditioner_;
  bool transposed_;
  IterativeWorkspace& work_;
};

}  // namespace

bool BlockJacobi::Compute(const BlockPattern& pattern,
                          const std::vector<double>& values) {
  inverses_.resize(9 * static_cast<size_t>(pattern.num_nodes()));
  for (int i = 0; i < pattern.num_nodes(); ++i) {
    const BlockSlot slot = pattern.Find(i, i);
    Eigen::Matrix3d block;
    for (int c = 0; c < 3; ++c) {
      for (int r = 0; r < 3; ++r)
        block(r, c) = values[slot.offset + c * slot.stride + r];
    }
    const Eigen::Matrix3d inverse = block.inverse();
    if (!inverse.allFinite()) return false;
    Eigen::Map<Eigen::Matrix3d>(inverses_.data() + 9 * static_cast<size_t>(i)) =
        inverse;
  }
  return true;
}

void BlockJacobi::Apply(const double* r, double* z, bool transposed) const {
  const int num_nodes = static_cast<int>(inverses_.size() / 9);
  for (int i = 0; i < num_nodes; ++i) {
    const Eigen::Map<const Eigen::Matrix3d> inverse(inverses_.data() +
                                                    9 * static_cast<size_t>(i));
    const Eigen::Map<const Eigen::Vector3d> in(r + 3 * i);
    Eigen::Map<Eigen::Vector3d> out(z + 3 * i);
    if (transposed) {
      out.noalias() = inverse.transpose() * in;
    } else {
      out.noalias() = inverse * in;
    }
  }
}

IterativeResult SolveIteratively(const BlockPattern& pattern,
                                 const std::vector<double>& values,
                                 const BlockJacobi& preconditioner, bool symmetric,
                                 bool transposed, double tolerance, const double* b,
                                 double* z, IterativeWorkspace* work) {
  Krylov krylov(pattern, values, preconditioner, transposed, work);
  return symmetric ? krylov.ConjugateGradients(b, tolerance, z)
                   : krylov.BiCgStab(b, tolerance, z);
}

}  // namespace dpe
