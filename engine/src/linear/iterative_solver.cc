#include "linear/iterative_solver.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "linear/vector_kernels.h"

namespace dpe {
namespace {

// The residual that counts as reached while its recursion has yet to be verified, and
// the reduction at which it is verified in any case: single precision carries no
// further.
constexpr double kMargin = 0.8;
constexpr double kReduction = 1e-5;
// Where verification finds that rounding has kept the residual this many times above
// the recursion, the next time it comes that much earlier.
constexpr double kLeastReduction = 1e-2;
// Where a restart's directions do not bring the residual closer to its targets by this
// factor a factorisation is the better way.
constexpr double kProgress = 0.1;

double Norm(const std::vector<double>& x) {
  return std::sqrt(Dot(x.size(), x.data(), x.data()));
}

}  // namespace

bool IterativeSolver::Prepare(const std::vector<double>& values, bool transposed) {
  values_ = values.data();
  transposed_ = transposed;
  return scaling_.Compute(values_, transposed) &&
         multigrid_.Compute(pattern_, values_, transposed);
}

double IterativeSolver::TrueResidual(const double* b, const double* z) {
  pattern_.Multiply(values_, transposed_, z, residual_.data());
  SubtractScaled(residual_.size(), b, 1.0, residual_.data());
  return Norm(residual_);
}

double IterativeSolver::Start(const double* b, double* z) {
  const size_t n = residual_.size();
  double c = 0.0;
  if (Dot(n, z, z) > 0.0) {
    // A guess of the right shape and the wrong size is a good guess.
    pattern_.Multiply(values_, transposed_, z, residual_.data());
    c = Dot(n, residual_.data(), b) / Dot(n, residual_.data(), residual_.data());
  }
  if (c == 0.0 || !std::isfinite(c)) {
    std::fill(z, z + n, 0.0);
    std::copy(b, b + n, residual_.begin());
  } else {
    Scale(n, c, z, z);
    SubtractScaled(n, b, c, residual_.data());
  }
  return Norm(residual_);
}

bool IterativeSolver::AddDirection() {
  const size_t n = r_.size();
  if (static_cast<int>(directions_.size()) == num_directions_) {
    directions_.emplace_back();
    directions_.back().u.resize(n);
    directions_.back().q.resize(n);
  }
  Direction& d = directions_[num_directions_];
  float* q = d.q.data();
  multigrid_.Apply(r_.data(), d.u.data());
  multigrid_.matrix().Multiply(d.u.data(), q);
  for (int i = 0; i < num_directions_; ++i) {
    const float* other = directions_[i].q.data();
    d.h[i] = Dot(n, other, q);
    AddScaled(n, -d.h[i], other, q);
  }
  const float length = std::sqrt(Dot(n, q, q));
  if (!(length > 0.0f) || !std::isfinite(length)) return false;
  d.h[num_directions_++] = length;
  Scale(n, 1.0f / length, q, q);
  const float a = Dot(n, q, r_.data());
  AddScaled(n, -a, q, r_.data());
  d.a = a;
  return true;
}

bool IterativeSolver::Reduce(double reduction, double norm, double* z) {
  const size_t n = r_.size();
  num_directions_ = 0;
  Scale(n, 1.0 / norm, residual_.data(), r_.data());
  double reached = 1.0;
  while (reached > reduction && num_directions_ < kDirections) {
    if (!AddDirection()) return false;
    reached = std::sqrt(Dot(n, r_.data(), r_.data()));
    if (!std::isfinite(reached)) return false;
  }
  // z += sum_j y_j u_j with H y = a, in the scale of the preconditioner's matrix.
  const double scale = norm * multigrid_.scale();
  for (int j = num_directions_ - 1; j >= 0; --j) {
    const double y = directions_[j].a / directions_[j].h[j];
    for (int i = 0; i < j; ++i) directions_[i].a -= directions_[j].h[i] * y;
    AddScaled(n, scale * y, directions_[j].u.data(), z);
  }
  return true;
}

IterativeResult IterativeSolver::Solve(double tolerance, const double* b, double* z) {
  const size_t n = static_cast<size_t>(pattern_.num_rows());
  residual_.resize(n);
  r_.resize(n);
  const double target = tolerance * std::sqrt(Dot(n, b, b));
  const double scaled_target = tolerance * scaling_.Norm(b);
  IterativeResult result;
  double norm = Start(b, z);
  double excess_before = std::numeric_limits<double>::infinity();
  double least_reduction = kReduction;
  while (std::isfinite(norm)) {
    const double scaled_norm = scaling_.Norm(residual_.data());
    result.converged = norm <= target && scaled_norm <= scaled_target;
    if (result.converged) break;
    // How far above its target the worse of the two is.
    const double excess = std::max(norm / target, scaled_norm / scaled_target);
    if (!(excess <= kProgress * excess_before)) break;
    const double reduction = std::max(kMargin / excess, least_reduction);
    const double norm_before = norm;
    const bool ok = Reduce(reduction, norm, z);
    result.iterations += num_directions_;
    if (!ok) break;
    norm = TrueResidual(b, z);
    excess_before = excess;
    least_reduction =
        std::min(std::max(norm / norm_before, kReduction), kLeastReduction);
  }
  return result;
}

}  // namespace dpe
