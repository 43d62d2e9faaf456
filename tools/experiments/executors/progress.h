// How far a campaign has come, on one line of a terminal.
#ifndef DPE_TOOLS_EXPERIMENTS_EXECUTORS_PROGRESS_H_
#define DPE_TOOLS_EXPERIMENTS_EXECUTORS_PROGRESS_H_

#include <chrono>
#include <map>
#include <string>

namespace dpe::experiments {

// Counts jobs, and says how long the rest will take if it is like those that have
// ended.
class Progress {
 public:
  // @param num_jobs  of the campaign
  // @param num_done  of them have a row already
  Progress(int num_jobs, int num_done);

  void JobEnded(const std::string& outcome);

  // "13 of 40 jobs, 1 failed; 2 running; about 3 min left"
  std::string Line(int num_running) const;
  std::string Line(int num_running, double elapsed_s) const;

  // By outcome, of this run.
  const std::map<std::string, int>& outcomes() const { return outcomes_; }

 private:
  const int num_jobs_, num_before_;
  const std::chrono::steady_clock::time_point start_;
  int num_ended_ = 0;  // in this run
  std::map<std::string, int> outcomes_;
};

// "45 s", "3 min", "2 h 10 min"
std::string DurationText(double seconds);

}  // namespace dpe::experiments

#endif  // DPE_TOOLS_EXPERIMENTS_EXECUTORS_PROGRESS_H_
