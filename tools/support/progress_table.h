// What estimate_cloth prints: a table while it runs and a summary at the end.
#ifndef DPE_TOOLS_SUPPORT_PROGRESS_TABLE_H_
#define DPE_TOOLS_SUPPORT_PROGRESS_TABLE_H_

#include <mutex>
#include <string>
#include <vector>

#include "dpe/estimation/estimation_job.h"
#include "dpe/estimation/estimator.h"

namespace dpe::tools {

// One line per iteration; on a terminal also a line that is overwritten while rollouts
// are under way, so that long iterations show signs of life.
class ProgressTable {
 public:
  explicit ProgressTable(bool is_terminal) : is_terminal_(is_terminal) {}

  void PrintHeader() const;
  void PrintIteration(const IterationReport& report);

  // Called often, from any thread that simulates; draws at most a few times a second.
  void Tick(double seconds);

 private:
  void EraseLine() const;

  bool is_terminal_;
  std::mutex mutex_;
  bool line_is_drawn_ = false;
  int next_iteration_ = 0;
  double last_tick_ = 0.0;  // s
};

// What was read and is about to be fitted.
void PrintTask(const EstimationInput& input);

// RMS over the fitted and the validated frames, of several captures also of each,
// parameters with unit, deviation where the truth is known, why it stopped, where the
// files are.
void PrintSummary(const EstimationInput& input, const EstimatorSummary& summary,
                  const std::vector<Validation>& validations,
                  const std::vector<std::string>& files);

}  // namespace dpe::tools

#endif  // DPE_TOOLS_SUPPORT_PROGRESS_TABLE_H_
