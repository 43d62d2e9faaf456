// Where and when something was measured.
#ifndef DPE_TOOLS_EXPERIMENTS_MACHINE_H_
#define DPE_TOOLS_EXPERIMENTS_MACHINE_H_

#include <string>

#include "experiments/record.h"

namespace dpe::experiments {

// processor (its model), cores, date ("2026-11-26", local time).
Record ThisMachine();

// The commit of the checkout in which the program lies: "1a2b3c4", with
// ", with changes" where files differ from it; empty if it lies in none.
std::string ProgramCommit(const std::string& program);

}  // namespace dpe::experiments

#endif  // DPE_TOOLS_EXPERIMENTS_MACHINE_H_
