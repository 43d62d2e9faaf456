// Calls that take long: other Python threads run meanwhile, Ctrl-C ends them, and the
// results do not depend on how many threads the BLAS would like to use.
//
// Python's signal handlers run in its main thread only and only where that thread says
// so. The engine polls `interrupted` once per step from the thread that made the call
// and from helpers; the calling thread then takes the GIL, every few hundredths of a
// second, and lets the handlers run (elsewhere than in the main thread this does
// nothing). What a handler raises is kept, the engine is told to stop, and once it has,
// the exception goes on its way.
#ifndef DPE_PYTHON_LONG_CALL_H_
#define DPE_PYTHON_LONG_CALL_H_

#include <pybind11/pybind11.h>

#include <atomic>
#include <chrono>
#include <memory>
#include <mutex>
#include <thread>

namespace dpe::python {

class Interrupts {
 public:
  Interrupts() = default;
  Interrupts(const Interrupts&) = delete;
  Interrupts& operator=(const Interrupts&) = delete;

  // For SimulatorOptions::interrupted and its like; from any thread, without the GIL.
  bool Poll();

  // Stops the engine at its next poll.
  void Stop() { stop_ = true; }

  // Stops it because a callback raised `error`; with the GIL. The first one counts.
  void Keep(pybind11::error_already_set error);

  // The exception that ended the call; null if there was none. With the GIL.
  pybind11::error_already_set* exception() { return exception_.get(); }

  // Throws that exception, if there was one. With the GIL.
  void Rethrow();

 private:
  using Clock = std::chrono::steady_clock;

  const std::thread::id caller_ = std::this_thread::get_id();
  Clock::time_point next_ = Clock::now();
  std::atomic<bool> stop_{false};
  std::unique_ptr<pybind11::error_already_set> exception_;
};

// While one exists, OpenBLAS uses one thread, as in the command line programs; then
// what it used before.
class OneBlasThread {
 public:
  OneBlasThread();
  ~OneBlasThread();
  OneBlasThread(const OneBlasThread&) = delete;
  OneBlasThread& operator=(const OneBlasThread&) = delete;
};

// Calls work() without the GIL. What interrupted it is kept in `interrupts`.
template <class Work>
auto CallWithoutGil(Interrupts* interrupts, const Work& work) {
  try {
    const pybind11::gil_scoped_release release;
    const OneBlasThread one_thread;
    return work();
  } catch (...) {
    // What the engine says of being stopped would hide why.
    interrupts->Rethrow();
    throw;
  }
}

// The same; with the GIL again, throws what interrupted it.
template <class Work>
auto CallLong(Interrupts* interrupts, const Work& work) {
  auto result = CallWithoutGil(interrupts, work);
  interrupts->Rethrow();
  return result;
}

}  // namespace dpe::python

#endif  // DPE_PYTHON_LONG_CALL_H_
