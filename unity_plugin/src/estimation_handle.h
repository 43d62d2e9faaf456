// An estimation and its thread.
#ifndef DPE_UNITY_ESTIMATION_HANDLE_H_
#define DPE_UNITY_ESTIMATION_HANDLE_H_

#include <atomic>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "call.h"
#include "dpe/c/estimation.h"
#include "dpe/estimation/estimation_job.h"
#include "handle_table.h"

namespace dpe::c {

// What is left of an estimation that is over.
struct EstimationOutcome {
  EstimatorSummary summary;
  double deviation_percent = 0.0;
  std::vector<std::string> files;
};

class EstimationHandle : public HandleObject,
                         public std::enable_shared_from_this<EstimationHandle> {
 public:
  static constexpr HandleKind kKind = HandleKind::kEstimation;

  // Cancels, and waits for the thread unless it is the caller.
  void Close() override;

  // work(EstimationJob&) before it has started. @throws ApiError after that
  template <class Work>
  void Configure(const Work& work) {
    const std::lock_guard<std::mutex> lock(mutex_);
    RequireState(DPE_ESTIMATION_IDLE);
    work(job_);
  }
  void SetCallback(dpe_progress_callback callback, void* user);

  void Start();
  void Cancel() { cancelled_ = true; }
  int Poll(dpe_progress* progress) const;
  int Wait(double seconds);

  // @throws ApiError as long as there is no result
  std::shared_ptr<const EstimationOutcome> outcome() const;

 private:
  void RequireState(int state) const;
  // In the thread.
  void Run();
  std::shared_ptr<const EstimationOutcome> Estimate();
  void Report(const IterationReport& report);
  void Finish(int state, std::shared_ptr<const EstimationOutcome> outcome);

  std::atomic<bool> cancelled_{false};
  mutable std::mutex mutex_;  // guards what follows, but job_ while it runs
  std::condition_variable finished_;
  EstimationJob job_;
  dpe_progress_callback callback_ = nullptr;
  void* user_ = nullptr;
  int state_ = DPE_ESTIMATION_IDLE;
  bool is_closed_ = false;
  int num_reports_ = 0;
  dpe_progress progress_{};
  std::shared_ptr<const EstimationOutcome> outcome_;
  std::thread thread_;
};

}  // namespace dpe::c

#endif  // DPE_UNITY_ESTIMATION_HANDLE_H_
