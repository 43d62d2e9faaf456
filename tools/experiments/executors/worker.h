// The process of one job, from the side of the process that watches it. All executors
// run jobs through this class, so that their rows are the same.
#ifndef DPE_TOOLS_EXPERIMENTS_EXECUTORS_WORKER_H_
#define DPE_TOOLS_EXPERIMENTS_EXECUTORS_WORKER_H_

#include <sys/types.h>

#include <chrono>
#include <string>

#include "experiments/experiment.h"
#include "experiments/row_store.h"

namespace dpe::experiments {

struct WorkerSettings {
  std::string program;      // absolute path of this program
  std::string working_dir;  // in which jobs run
  double timeout_s = 0.0;   // then a job is killed; 0: never
  // s to wait before the row of a job is written that was killed from outside. What
  // ends a job and the process that watches it (a scheduler that cancels or preempts,
  // or a node that goes down) may end the job first, and that is no result of it.
  double killed_delay_s = 0.0;
};

// The program is started once more as `PROGRAM --internal_job DIR ID RESULT_FILE`. The
// job is in a process group of its own; where the system can (Linux) it dies with the
// process that watches it. It is told to use one BLAS thread. What it prints goes into
// its log.
class Worker {
 public:
  // @throws SceneError if no process can be made
  Worker(const Job& job, const WorkerSettings& settings, const RowStore& store);
  // Kills it if it still runs.
  ~Worker();
  Worker(const Worker&) = delete;
  Worker& operator=(const Worker&) = delete;

  // Kills it if its time is over. True once it has ended; its row has then been
  // written.
  bool Poll();

  const Job& job() const { return job_; }
  // Of an ended worker: "done", "failed", ...
  std::string outcome() const { return result_.Text("outcome", ""); }

 private:
  double Elapsed() const;
  // @param usage  wall_s, cpu_s and peak_mib
  void Finish(int status, const Record& usage);

  const Job job_;
  const WorkerSettings settings_;
  const RowStore store_;
  const std::chrono::steady_clock::time_point start_;
  std::string result_path_;
  pid_t process_ = -1;
  bool has_ended_ = false;
  bool is_over_time_ = false;
  Record result_;
};

// What the process of a job does: runs it and writes what it reports, or why it failed,
// into a file. @return its exit code
int RunJobProcess(const std::string& dir, const std::string& id,
                  const std::string& result_path);

}  // namespace dpe::experiments

#endif  // DPE_TOOLS_EXPERIMENTS_EXECUTORS_WORKER_H_
