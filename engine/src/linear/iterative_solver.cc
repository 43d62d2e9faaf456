#include "linear/iterative_solver.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "linear/block_product.h"
#include "linear/vector_kernels.h"

namespace dpe {
namespace {

// Where so many directions do not reduce the residual by this factor a factorisation is
// the better way.
constexpr double kProgress = 0.1;

}  // namespace

bool IterativeSolver::Prepare(const std::vector<double>& values, bool transposed) {
  values_ = values.data();
  transposed_ = transposed;
  return multigrid_.Compute(pattern_, values_, transposed);
}

void IterativeSolver::Multiply(const double* x, double* y) const {
  if (transposed_) {
    BlockProductTransposed(pattern_, values_, x, y);
  } else {
    BlockProduct(pattern_, values_, x, y);
  }
}

double IterativeSolver::TrueResidual(const double* b, const double* z) {
  Multiply(z, r_.data());
  SubtractFrom(r_.size(), b, r_.data());
  return std::sqrt(Dot(r_.size(), r_.data(), r_.data()));
}

double IterativeSolver::Start(const double* b, double* z) {
  const size_t n = r_.size();
  if (Dot(n, z, z) == 0.0) {
    std::copy(b, b + n, r_.begin());
    return std::sqrt(Dot(n, b, b));
  }
  // A guess of the right shape and the wrong size is a good guess.
  Multiply(z, r_.data());
  const double square = Dot(n, r_.data(), r_.data());
  const double c = square > 0.0 ? Dot(n, r_.data(), b) / square : 0.0;
  if (!std::isfinite(c)) {
    std::fill(z, z + n, 0.0);
    std::copy(b, b + n, r_.data());
  } else {
    for (size_t i = 0; i < n; ++i) {
      z[i] *= c;
      r_[i] = b[i] - c * r_[i];
    }
  }
  return std::sqrt(Dot(n, r_.data(), r_.data()));
}

double IterativeSolver::Iterate(double norm) {
  const size_t n = r_.size();
  if (static_cast<int>(directions_.size()) == num_directions_) {
    directions_.emplace_back();
    directions_.back().u.resize(n);
    directions_.back().q.resize(n);
  }
  Direction& d = directions_[num_directions_];
  multigrid_.Apply(r_.data(), 1.0 / norm, d.u.data());
  std::copy(d.u.begin(), d.u.end(), work_.begin());
  Multiply(work_.data(), d.q.data());
  for (int i = 0; i < num_directions_; ++i) {
    const double* q = directions_[i].q.data();
    d.h[i] = Dot(n, q, d.q.data());
    AddScaled(n, -d.h[i], q, d.q.data());
  }
  const double length = std::sqrt(Dot(n, d.q.data(), d.q.data()));
  d.h[num_directions_] = length;
  if (!(length > 0.0)) return std::numeric_limits<double>::quiet_NaN();
  Scale(n, 1.0 / length, d.q.data());
  d.a = Dot(n, d.q.data(), r_.data());
  AddScaled(n, -d.a, d.q.data(), r_.data());
  ++num_directions_;
  return std::sqrt(Dot(n, r_.data(), r_.data()));
}

void IterativeSolver::AddDirections(double* z) {
  for (int i = num_directions_ - 1; i >= 0; --i) {
    Direction& d = directions_[i];
    d.a /= d.h[i];
    for (int k = 0; k < i; ++k) directions_[k].a -= d.h[k] * d.a;
    AddScaled(r_.size(), d.a, d.u.data(), z);
  }
  num_directions_ = 0;
}

IterativeResult IterativeSolver::Solve(double tolerance, const double* b, double* z) {
  const size_t n = static_cast<size_t>(pattern_.num_rows());
  r_.resize(n);
  work_.resize(n);
  num_directions_ = 0;
  const double target = tolerance * std::sqrt(Dot(n, b, b));
  IterativeResult result;
  double norm = Start(b, z);
  double norm_before = std::numeric_limits<double>::infinity();
  while (std::isfinite(norm)) {
    result.converged = norm <= target;
    if (result.converged || !(norm <= kProgress * norm_before)) break;
    norm_before = norm;
    while (norm > target && num_directions_ < kDirections) {
      norm = Iterate(norm);
      ++result.iterations;
    }
    if (!std::isfinite(norm)) break;
    AddDirections(z);
    // The recursion for r drifts away from the residual; only the latter counts.
    norm = TrueResidual(b, z);
  }
  return result;
}

}  // namespace dpe
