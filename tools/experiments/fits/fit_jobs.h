// What the experiments on fits share: their jobs and columns.
#ifndef DPE_TOOLS_EXPERIMENTS_FITS_FIT_JOBS_H_
#define DPE_TOOLS_EXPERIMENTS_FITS_FIT_JOBS_H_

#include <string>
#include <vector>

#include "experiments/experiment.h"

namespace dpe::experiments {

// A fit to the preset's own motion, validated over 500 frames, without error bars. Its
// id is SCENE-FRAMES_SETTINGS_START.
// @param init  "auto", "uniform:10", ... as estimate_cloth's
Job PresetFit(const std::string& preset, int frames, const std::string& settings,
              const std::string& init);

// The row of this id, or null.
const Row* FindRow(const std::vector<Row>& rows, const std::string& id);

// The number of a key, not-a-number if it is absent or the row is null.
double NumberOf(const Row* row, const std::string& key);

// What a row reached, for a person: "converged", or "crashed", "timed_out", ...
std::string EndOf(const Row& row);

}  // namespace dpe::experiments

#endif  // DPE_TOOLS_EXPERIMENTS_FITS_FIT_JOBS_H_
