// A pool of processes on this machine.
#include <chrono>
#include <memory>
#include <thread>

#include "experiments/executors/executor.h"

namespace dpe::experiments {
namespace {

// Short against the jobs, and so rare that it costs nothing.
constexpr std::chrono::milliseconds kPause(2);
constexpr int kPausesPerTick = 100;

}  // namespace

bool RunLocally(const std::vector<Job>& jobs, const WorkerSettings& settings,
                int num_processes, const RowStore& store,
                const ExecutorCallbacks& callbacks) {
  std::vector<std::unique_ptr<Worker>> running;
  size_t next = 0;
  for (int pauses = 0; next < jobs.size() || !running.empty(); ++pauses) {
    if (callbacks.interrupted()) return false;
    while (next < jobs.size() && static_cast<int>(running.size()) < num_processes) {
      running.push_back(std::make_unique<Worker>(jobs[next++], settings, store));
    }
    for (size_t w = 0; w < running.size();) {
      if (running[w]->Poll()) {
        callbacks.finished(running[w]->job(), running[w]->outcome());
        running.erase(running.begin() + static_cast<std::ptrdiff_t>(w));
      } else {
        ++w;
      }
    }
    if (pauses % kPausesPerTick == 0) callbacks.tick(static_cast<int>(running.size()));
    std::this_thread::sleep_for(kPause);
  }
  return true;
}

}  // namespace dpe::experiments
