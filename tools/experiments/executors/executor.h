// How the jobs of a campaign get to run.
#ifndef DPE_TOOLS_EXPERIMENTS_EXECUTORS_EXECUTOR_H_
#define DPE_TOOLS_EXPERIMENTS_EXECUTORS_EXECUTOR_H_

#include <functional>
#include <string>
#include <vector>

#include "experiments/executors/worker.h"
#include "experiments/experiment.h"
#include "experiments/row_store.h"

namespace dpe::experiments {

// What a caller is told, and is asked, while jobs run.
struct ExecutorCallbacks {
  // A row has been written.
  std::function<void(const Job& job, const std::string& outcome)> finished;
  // Now and then, at least once a second.
  std::function<void(int num_running)> tick;
  // True: stop the jobs that run, keep the rows.
  std::function<bool()> interrupted;
};

// Runs jobs until each has a row in the store, or the caller interrupts.
// @return false if it was interrupted
// @throws SceneError if jobs cannot be run at all
bool RunLocally(const std::vector<Job>& jobs, const WorkerSettings& settings,
                int num_processes, const RowStore& store,
                const ExecutorCallbacks& callbacks);

}  // namespace dpe::experiments

#endif  // DPE_TOOLS_EXPERIMENTS_EXECUTORS_EXECUTOR_H_
