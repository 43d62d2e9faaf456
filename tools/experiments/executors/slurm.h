// Job arrays on a Slurm cluster.
//
// A submission n is the file DIR/slurm/tasks_n.txt, one job id per line, and an array
// whose element i runs `PROGRAM --internal_task DIR TASKS i TIMEOUT`, which runs the
// job of line i as the local executor does (worker.h) and writes its row into DIR: a
// folder that the nodes share, as they share the program.
//
// Arrays are named dpe_KEY_n, KEY being made of DIR, so that a program that is started
// again finds in the queue what one that was killed has submitted, and waits for it
// rather than running jobs twice. A task whose job has a row already does nothing.
//
// When nothing of a campaign is in the queue any more, jobs without a row (their node
// failed, they were cancelled or killed with all that watched them) are submitted
// again; after `max_retries` of those a row says so.
#ifndef DPE_TOOLS_EXPERIMENTS_EXECUTORS_SLURM_H_
#define DPE_TOOLS_EXPERIMENTS_EXECUTORS_SLURM_H_

#include <string>
#include <vector>

#include "experiments/executors/executor.h"

namespace dpe::experiments {

struct SlurmOptions {
  int max_retries = 2;
  int max_running = 0;  // elements of an array at once; 0: as Slurm decides
  std::string partition;
  std::vector<std::string> sbatch_options;  // more of them, as they are
  double poll_interval_s = 2.0;
};

// As RunLocally. Interrupted, it cancels what it has submitted.
bool RunOnSlurm(const std::vector<Job>& jobs, const WorkerSettings& settings,
                const SlurmOptions& options, const RowStore& store,
                const ExecutorCallbacks& callbacks);

// What an element of an array does. @return its exit code
int RunSlurmTask(const std::string& program, const std::string& dir,
                 const std::string& tasks_path, int index, double timeout_s);

}  // namespace dpe::experiments

#endif  // DPE_TOOLS_EXPERIMENTS_EXECUTORS_SLURM_H_
