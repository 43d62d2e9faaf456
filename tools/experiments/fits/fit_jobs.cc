#include "experiments/fits/fit_jobs.h"

#include <algorithm>
#include <limits>

namespace dpe::experiments {

Job PresetFit(const std::string& preset, int frames, const std::string& settings,
              const std::string& init) {
  std::string start = init == "auto" ? "default" : init;
  std::replace(start.begin(), start.end(), ':', '-');
  Job job;
  job.Set("id", preset + "-" + std::to_string(frames) + "_" + settings + "_" + start);
  job.Set("kind", "estimate");
  job.Set("preset", Record::Value(preset));
  job.Set("frames", frames);
  job.Set("settings", Record::Value(settings));
  job.Set("init", Record::Value(init));
  job.Set("validate_frames", 500);
  return job;
}

const Row* FindRow(const std::vector<Row>& rows, const std::string& id) {
  for (const Row& row : rows) {
    if (row.Text("id", "") == id) return &row;
  }
  return nullptr;
}

double NumberOf(const Row* row, const std::string& key) {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  return row == nullptr ? kNone : row->Number(key, kNone);
}

std::string EndOf(const Row& row) {
  const std::string outcome = row.Text("outcome", "");
  return outcome == "done" ? row.Text("termination", "") : outcome;
}

}  // namespace dpe::experiments
