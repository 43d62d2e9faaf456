#include "long_call.h"

#include <utility>

// Weak: null if the module was linked with another BLAS.
extern "C" {
void openblas_set_num_threads(int num_threads) __attribute__((weak));
int openblas_get_num_threads() __attribute__((weak));
}

namespace py = pybind11;

namespace dpe::python {
namespace {

// Short against the second within which Ctrl-C has to be noticed, long against what
// waiting for another Python thread's GIL costs (5 ms).
constexpr std::chrono::milliseconds kPollInterval{50};

std::mutex blas_mutex;
int num_blas_users = 0;
int blas_threads_before = 1;

}  // namespace

bool Interrupts::Poll() {
  if (stop_) return true;
  if (std::this_thread::get_id() != caller_) return false;
  const Clock::time_point now = Clock::now();
  if (now < next_) return false;
  next_ = now + kPollInterval;
  const py::gil_scoped_acquire acquire;
  if (PyErr_CheckSignals() != 0) Keep(py::error_already_set());
  return stop_;
}

void Interrupts::Keep(py::error_already_set error) {
  if (exception_ == nullptr) {
    exception_ = std::make_unique<py::error_already_set>(std::move(error));
  }
  stop_ = true;
}

void Interrupts::Rethrow() {
  if (exception_ != nullptr) throw py::error_already_set(*exception_);
}

OneBlasThread::OneBlasThread() {
  if (openblas_set_num_threads == nullptr || openblas_get_num_threads == nullptr) {
    return;
  }
  const std::lock_guard<std::mutex> lock(blas_mutex);
  if (num_blas_users++ > 0) return;
  blas_threads_before = openblas_get_num_threads();
  openblas_set_num_threads(1);
}

OneBlasThread::~OneBlasThread() {
  if (openblas_set_num_threads == nullptr || openblas_get_num_threads == nullptr) {
    return;
  }
  const std::lock_guard<std::mutex> lock(blas_mutex);
  if (--num_blas_users == 0) openblas_set_num_threads(blas_threads_before);
}

}  // namespace dpe::python
