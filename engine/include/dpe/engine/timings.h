// Where a run's time went.
#ifndef DPE_ENGINE_TIMINGS_H_
#define DPE_ENGINE_TIMINGS_H_

#include <array>
#include <atomic>
#include <chrono>
#include <string>

#include "dpe/engine/export.h"

namespace dpe {

enum class TimedPart {
  kForces,         // evaluating forces in rollouts
  kAssembly,       // assembling step matrices in rollouts
  kFactorization,  // factorising them
  kSolve,          // solving with them
  kDerivatives,    // gradient, tangent and adjoint passes, all they contain
  kLeastSquares,   // linear algebra of a least-squares optimiser
};

// Adds up wall-clock time per part; parts do not overlap. Rollouts of several objects
// on several threads add their own times.
class DPE_ENGINE_API Timings {
 public:
  static constexpr int kNumParts = 6;

  void Add(TimedPart part, std::chrono::nanoseconds time) {
    nanoseconds_[static_cast<int>(part)] += time.count();
    ++calls_[static_cast<int>(part)];
  }
  double Seconds(TimedPart part) const {
    return 1e-9 * static_cast<double>(nanoseconds_[static_cast<int>(part)]);
  }
  long Calls(TimedPart part) const { return calls_[static_cast<int>(part)]; }

  // While a derivative pass runs, what it does counts as kDerivatives alone.
  void set_in_derivatives(bool value) { in_derivatives_ = value; }
  bool in_derivatives() const { return in_derivatives_; }

  // A table with one line per part that took time, and one for the rest of
  // `total_seconds`, under the name `rest`.
  std::string Table(double total_seconds, const std::string& rest) const;

 private:
  std::array<std::atomic<long long>, kNumParts> nanoseconds_{};
  std::array<std::atomic<long>, kNumParts> calls_{};
  std::atomic<bool> in_derivatives_{false};
};

// Adds its own lifetime to a part; does nothing without `timings`.
class ScopedTimer {
 public:
  ScopedTimer(Timings* timings, TimedPart part) : part_(part) {
    const bool is_pass = part == TimedPart::kDerivatives;
    if (timings == nullptr || (timings->in_derivatives() && !is_pass)) return;
    timings_ = timings;
    if (is_pass) timings_->set_in_derivatives(true);
    start_ = std::chrono::steady_clock::now();
  }
  ~ScopedTimer() {
    if (timings_ == nullptr) return;
    timings_->Add(part_, std::chrono::steady_clock::now() - start_);
    if (part_ == TimedPart::kDerivatives) timings_->set_in_derivatives(false);
  }
  ScopedTimer(const ScopedTimer&) = delete;
  ScopedTimer& operator=(const ScopedTimer&) = delete;

 private:
  Timings* timings_ = nullptr;
  TimedPart part_;
  std::chrono::steady_clock::time_point start_;
};

}  // namespace dpe

#endif  // DPE_ENGINE_TIMINGS_H_
