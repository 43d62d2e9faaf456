// Checks a TrajectoryCost against what it promises: derivatives against central
// differences, and that it reads no other states than those it lists. Run it once on
// every cost of your own, at a trajectory on which it has no kink: a wrong derivative
// does not fail loudly, it makes a fit slow or wrong.
#ifndef DPE_ESTIMATION_TRAJECTORY_COST_CHECK_H_
#define DPE_ESTIMATION_TRAJECTORY_COST_CHECK_H_

#include <string>

#include "dpe/engine/trajectory.h"
#include "dpe/estimation/export.h"
#include "dpe/estimation/trajectory_cost.h"

namespace dpe {

struct TrajectoryCostCheck {
  // The derivative of one residual with respect to one coordinate of a state.
  struct Entry {
    int residual = -1;
    int object = -1;
    int frame = -1;
    int vertex = -1;
    char axis = '?';  // x, y or z
    bool is_velocity = false;
    double analytic = 0.0;
    double numeric = 0.0;  // with the step at which the two agree best
  };

  bool ok = false;
  std::string message;  // one sentence: what is wrong, or how good it is

  // The largest difference, over all coordinates, between a column of the derivative
  // and its difference quotient, relative to the latter (or to 1e-6 of the longest
  // column, for columns that are shorter), and the entry of that column which differs
  // most.
  double relative_error = 0.0;
  Entry worst;
};

// @param cost        to check
// @param trajectory  simulated states that `cost` can be evaluated on
// @param tolerance   largest relative_error to accept
// @return            never throws for a wrong cost: `message` says what is wrong
DPE_ESTIMATION_API TrajectoryCostCheck CheckTrajectoryCost(const TrajectoryCost& cost,
                                                           const Trajectory& trajectory,
                                                           double tolerance = 1e-6);

}  // namespace dpe

#endif  // DPE_ESTIMATION_TRAJECTORY_COST_CHECK_H_
