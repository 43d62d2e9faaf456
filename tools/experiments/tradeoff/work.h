// A cost that is the same on every machine and however busy it is.
#ifndef DPE_TOOLS_EXPERIMENTS_TRADEOFF_WORK_H_
#define DPE_TOOLS_EXPERIMENTS_TRADEOFF_WORK_H_

#include "experiments/record.h"

namespace dpe::experiments::tradeoff {

// What the parts of a rollout cost, in evaluations of the forces. Defaults: from
// processor times of the legacy cloths of 12 x 12 vertices, rounded (a force evaluation
// takes 8 us, a linearly implicit step 0.145 ms, a Newton iteration more 0.06 ms, a
// linearly implicit step by the Krylov method to 1e-5 0.1 ms).
struct WorkWeights {
  double assembly = 3.0;
  double factorisation = 10.0;
  double solve = 3.5;
  double krylov_solve = 8.0;  // with its preparation, to a residual of 1e-5
};

// Of a row with the counts that SetWork gives, per frame; NaN where it has none.
double Work(const Record& row, const WorkWeights& weights = {});

}  // namespace dpe::experiments::tradeoff

#endif  // DPE_TOOLS_EXPERIMENTS_TRADEOFF_WORK_H_
