// The weights of smoothness priors, chosen by frames that a fit has not seen.
//
// A fit that is too free follows the noise of what it sees, one that is too smooth
// misses what is there; both predict what comes next badly. So the last 20 % of the
// frames are held out, the rest is fitted with every weight of a logarithmic grid, and
// the weight is taken whose fit has the least whitened cost in the held-out frames
// (cross-validation for a sequence, which cannot be shuffled: Arlot & Celisse, A survey
// of cross-validation procedures for model selection, 2010, section 8.1).
//
// Candidates go from strong to weak, each from the answer of the one before: the
// strongest is a fit with hardly more freedom than one value and finds its way from
// far; a weaker one has little left to do. The path ends when candidates have become
// worse several times in a row. All priors whose weight is to be chosen share one
// weight: it means the same for all of them.
#ifndef DPE_ESTIMATION_HELD_OUT_WEIGHTS_H_
#define DPE_ESTIMATION_HELD_OUT_WEIGHTS_H_

#include <functional>
#include <vector>

#include "dpe/estimation/estimator.h"
#include "fit_setup.h"

namespace dpe {

// True if some smoothness prior has no weight yet.
bool HasWeightsToChoose(const EstimatorOptions& options);

// A fit with all weights given.
using FitFunction = std::function<EstimatorSummary(
    const std::vector<CaptureView>& captures, const EstimatorOptions& options)>;

// `fit` with the weights chosen first, by the last frames of every capture. Candidates
// take at most half of options.max_seconds; where one is interrupted, the best so far
// is the result. A fit that is resumed takes the weights of its checkpoint: there is
// none before they are chosen.
EstimatorSummary FitWithChosenWeights(const std::vector<CaptureView>& captures,
                                      const EstimatorOptions& options,
                                      const FitFunction& fit);

}  // namespace dpe

#endif  // DPE_ESTIMATION_HELD_OUT_WEIGHTS_H_
