// What run_experiments says to Slurm, and what it understands of the answers.
#ifndef DPE_TOOLS_EXPERIMENTS_EXECUTORS_SLURM_COMMANDS_H_
#define DPE_TOOLS_EXPERIMENTS_EXECUTORS_SLURM_COMMANDS_H_

#include <set>
#include <string>
#include <vector>

namespace dpe::experiments {

// One element of a job array that is in the queue: waiting, running, or ending.
struct QueuedTask {
  std::string array;  // Slurm's number of the array
  std::string name;   // that it was submitted with
  int index = 0;
  bool is_running = false;
};

// The user's tasks in the queue whose name begins with `prefix`.
// @throws SceneError with what squeue says if it fails several times in a row
std::vector<QueuedTask> ReadQueue(const std::string& prefix);

// Of the lines "ARRAY|INDEX|STATE|NAME" that squeue is asked for; other lines are left
// out.
std::vector<QueuedTask> ParseQueue(const std::string& lines, const std::string& prefix);

// The number of elements that an array may have (MaxArraySize of slurm.conf; Slurm's
// default where it cannot be found out).
int MaxArraySize();

// @throws SceneError with what sbatch says; also if there is no sbatch
// @return Slurm's number of the array
std::string SubmitArray(const std::vector<std::string>& options,
                        const std::string& script);

void CancelArrays(const std::set<std::string>& arrays);

}  // namespace dpe::experiments

#endif  // DPE_TOOLS_EXPERIMENTS_EXECUTORS_SLURM_COMMANDS_H_
