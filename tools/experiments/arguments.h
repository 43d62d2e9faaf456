// What every kind of job checks of its arguments.
#ifndef DPE_TOOLS_EXPERIMENTS_ARGUMENTS_H_
#define DPE_TOOLS_EXPERIMENTS_ARGUMENTS_H_

#include <string>
#include <vector>

#include "experiments/experiment.h"

namespace dpe::experiments {

// Beside "id" and "kind" these are the arguments of a job; "note" and keys that begin
// with "note_" are free, for what a campaign wants in its table.
// @throws SceneError naming an argument that is not among them
void RequireKnownArguments(const Job& job, const std::vector<std::string>& known);

}  // namespace dpe::experiments

#endif  // DPE_TOOLS_EXPERIMENTS_ARGUMENTS_H_
