// Tables of the stability experiment; its plots are in stability_plots.h.
#ifndef DPE_TOOLS_EXPERIMENTS_STABILITY_STABILITY_REPORT_H_
#define DPE_TOOLS_EXPERIMENTS_STABILITY_STABILITY_REPORT_H_

#include <string>
#include <vector>

#include "experiments/experiment.h"

namespace dpe::experiments {

// How many cells came to which result, and how many gradients to which verdict: "438
// accurate, 36 inaccurate ...".
std::string CountText(const std::vector<Row>& cells);

// @param rows  of jobs of the kinds "stability" and "energy", those that did not end
//              included
Results StabilityResults(const std::vector<Row>& rows);

}  // namespace dpe::experiments

#endif  // DPE_TOOLS_EXPERIMENTS_STABILITY_STABILITY_REPORT_H_
