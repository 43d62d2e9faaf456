#include "estimation_handle.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

namespace dpe::c {

void EstimationHandle::RequireState(int state) const {
  if (is_closed_) {
    throw ApiError(DPE_ERROR_STATE, "the estimation is being destroyed");
  }
  if (state_ == state) return;
  throw ApiError(DPE_ERROR_STATE, "the estimation has been started before");
}

void EstimationHandle::SetCallback(dpe_progress_callback callback, void* user) {
  const std::lock_guard<std::mutex> lock(mutex_);
  RequireState(DPE_ESTIMATION_IDLE);
  callback_ = callback;
  user_ = user;
}

void EstimationHandle::Start() {
  const std::lock_guard<std::mutex> lock(mutex_);
  RequireState(DPE_ESTIMATION_IDLE);
  Require(!job_.scene_paths.empty(), "the option \"scene\" has to be set first");
  // The thread holds the object: it may be destroyed by its own callback.
  thread_ = std::thread([self = shared_from_this()] { self->Run(); });
  state_ = DPE_ESTIMATION_RUNNING;
}

void EstimationHandle::Close() {
  Cancel();
  std::thread thread;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    is_closed_ = true;
    thread.swap(thread_);
  }
  if (!thread.joinable()) return;
  if (thread.get_id() == std::this_thread::get_id()) {
    HandleTable::Global().Adopt(std::move(thread));
  } else {
    thread.join();
  }
}

int EstimationHandle::Poll(dpe_progress* progress) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (progress != nullptr) *progress = progress_;
  return state_;
}

int EstimationHandle::Wait(double seconds) {
  constexpr double kLongest = 1e6;  // s; what a clock's duration can surely hold
  Require(seconds >= 0.0, "seconds; accepted is a number that is not negative");
  std::unique_lock<std::mutex> lock(mutex_);
  if (thread_.get_id() == std::this_thread::get_id()) return state_;
  finished_.wait_for(lock, std::chrono::duration<double>(std::min(seconds, kLongest)),
                     [this] { return state_ != DPE_ESTIMATION_RUNNING; });
  return state_;
}

std::shared_ptr<const EstimationOutcome> EstimationHandle::outcome() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (!outcome_) throw ApiError(DPE_ERROR_STATE, "there is no result");
  return outcome_;
}

void EstimationHandle::Report(const IterationReport& report) {
  dpe_progress_callback callback = nullptr;
  void* user = nullptr;
  dpe_progress progress{};
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    ++num_reports_;
    progress_.iteration = report.iteration;
    progress_.num_frames = report.num_frames;
    progress_.cost = report.cost;
    progress_.rms = report.rms;
    progress_.seconds = report.seconds;
    // Most fits take about as many iterations.
    progress_.fraction = num_reports_ / (num_reports_ + 10.0);
    progress = progress_;
    // Nobody expects to be called by an estimation that is destroyed.
    if (!is_closed_) callback = callback_, user = user_;
  }
  if (callback != nullptr) callback(user, &progress);
}

std::shared_ptr<const EstimationOutcome> EstimationHandle::Estimate() {
  job_.options.progress = [this](const IterationReport& report) { Report(report); };
  job_.options.interrupted = [this] { return cancelled_.load(); };
  EstimationInput input = LoadEstimationInput(job_);
  ModelSelection selection;
  const bool is_selected = !input.auto_objects.empty();
  auto outcome = std::make_shared<EstimationOutcome>();
  outcome->summary = RunEstimation(job_.options, {}, &input, &selection);
  const EstimatorSummary& summary = outcome->summary;
  outcome->deviation_percent = input.truth_is_known
                                   ? ParameterDeviationPercent(summary, input.scenes())
                                   : std::nan("");
  if (!job_.output_dir.empty()) {
    outcome->files = WriteResults(
        job_, input, summary, Validate(summary, input, job_.options.num_threads),
        PrepareOutputDir(job_, input), is_selected ? &selection : nullptr);
  }
  return outcome;
}

void EstimationHandle::Run() {
  try {
    auto outcome = Estimate();
    const bool is_cancelled = outcome->summary.termination == Termination::kInterrupted;
    Finish(is_cancelled ? DPE_ESTIMATION_CANCELLED : DPE_ESTIMATION_DONE,
           std::move(outcome));
  } catch (...) {
    StatusOfException(this);
    // Reading is interrupted by what looks like an error.
    Finish(cancelled_ ? DPE_ESTIMATION_CANCELLED : DPE_ESTIMATION_FAILED, nullptr);
  }
}

void EstimationHandle::Finish(int state,
                              std::shared_ptr<const EstimationOutcome> outcome) {
  const std::lock_guard<std::mutex> lock(mutex_);
  state_ = state;
  outcome_ = std::move(outcome);
  if (state == DPE_ESTIMATION_DONE) progress_.fraction = 1.0;
  finished_.notify_all();
}

}  // namespace dpe::c
