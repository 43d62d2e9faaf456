// Which candidates the trade-off experiment measures.
#ifndef DPE_TOOLS_EXPERIMENTS_TRADEOFF_GRID_H_
#define DPE_TOOLS_EXPERIMENTS_TRADEOFF_GRID_H_

#include <vector>

#include "dpe/engine/quality.h"
#include "experiments/experiment.h"

namespace dpe::experiments::tradeoff {

// Settings of simulations, in full: every integrator with 1, 2, 4, 8, 16 and 32 steps
// per frame; each that solves linear systems with the direct solver, with the Krylov
// method to 1e-2, 1e-5 and 1e-8, and with "auto"; each that has Newton iterations, with
// those to 1e-13 (the default), 1e-6, 1e-4 and 1e-2 of the direct solver, and to 1e-6
// and 1e-4 of the Krylov method; and implicit Euler and TR-BDF2 with 64 steps. The
// settings of the presets (quality.h) are among them.
std::vector<StepSettings> SimulationGrid();

// All jobs: for side, corners and flag, the reference's uncertainty, the simulations,
// and fits that vary one thing at a time from a centre (TR-BDF2 with 2 steps, the
// groups of equal stiffness, LM, all frames at once, 50 frames, 20 of the flag):
// integrator and steps in full, and around it what is estimated, the optimiser, the
// horizon and its length, the start, the precision of the linear solver and the memory
// limit.
std::vector<Job> TradeoffJobs();

}  // namespace dpe::experiments::tradeoff

#endif  // DPE_TOOLS_EXPERIMENTS_TRADEOFF_GRID_H_
