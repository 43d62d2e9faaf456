#include "experiments/executors/progress.h"

#include <cmath>
#include <sstream>

namespace dpe::experiments {

Progress::Progress(int num_jobs, int num_done)
    : num_jobs_(num_jobs),
      num_before_(num_done),
      start_(std::chrono::steady_clock::now()) {}

void Progress::JobEnded(const std::string& outcome) {
  ++num_ended_;
  ++outcomes_[outcome];
}

std::string Progress::Line(int num_running) const {
  const std::chrono::duration<double> elapsed =
      std::chrono::steady_clock::now() - start_;
  return Line(num_running, elapsed.count());
}

std::string Progress::Line(int num_running, double elapsed_s) const {
  std::ostringstream line;
  const int done = num_before_ + num_ended_;
  line << done << " of " << num_jobs_ << " jobs";
  for (const auto& [outcome, count] : outcomes_) {
    if (outcome != "done") line << ", " << count << ' ' << outcome;
  }
  line << "; " << num_running << " running";
  if (num_ended_ > 0 && done < num_jobs_) {
    const double rest = elapsed_s / num_ended_ * (num_jobs_ - done);
    line << "; about " << DurationText(rest) << " left";
  }
  return line.str();
}

std::string DurationText(double seconds) {
  std::ostringstream text;
  const long rounded = std::lround(seconds);
  if (rounded < 90) {
    text << rounded << " s";
  } else if (rounded < 90 * 60) {
    text << (rounded + 30) / 60 << " min";
  } else {
    const long minutes = (rounded + 30) / 60;
    text << minutes / 60 << " h " << minutes % 60 << " min";
  }
  return text.str();
}

}  // namespace dpe::experiments
