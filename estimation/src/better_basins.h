// A fit of a handful of parameters that has converged, looked at from outside: is there
// a lower minimum than the one that it is in?
#ifndef DPE_ESTIMATION_BETTER_BASINS_H_
#define DPE_ESTIMATION_BETTER_BASINS_H_

#include <functional>

#include "dpe/estimation/estimator.h"
#include "fit_problem.h"
#include "stop_control.h"

namespace dpe {

struct BasinSearch {
  FitProblem* fit = nullptr;
  StopControl* stop = nullptr;
  // Goes down from the problem's coordinates, leaves the best point of all there, and
  // says in `summary` how that ended.
  std::function<void()> minimise;
  // Whose termination and message are those of the fit that gave the best point; a note
  // is added for each fit that was better than the one before.
  EstimatorSummary* summary = nullptr;
  bool along_valleys = true;  // false: trial values alone
};

// Repeats the fit from better trial values of single parameters over their whole range
// (FindBetterTrialPoint), then from other minima along the valley that the best point
// lies in (ProfileMinima), each a few times as long as that lowers the cost.
void SearchBetterBasins(const BasinSearch& search);

}  // namespace dpe

#endif  // DPE_ESTIMATION_BETTER_BASINS_H_
