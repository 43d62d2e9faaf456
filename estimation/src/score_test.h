// Whether further parameters could explain anything of what a fit has left, without
// fitting them: Rao's score test.
//
// At the simpler fit, seen as a point of the richer model, let r be the residuals (m),
// J = U S V^T their derivative with respect to the richer model's coordinates (mostly
// logarithms), and s^2 = |r|^2 / m. Of the directions only those p count in which a
// change of the coordinates by one (a factor e) changes the motion by more than the
// noise of one coordinate, S_i > s: others could explain something only by values that
// no cloth has. If the simpler model is true, r is noise, and the part of it that these
// directions can explain to first order, and what they cannot,
//
//   G = sum_i (u_i.r)^2 = sum_i (v_i.J^T r / S_i)^2,    s_u^2 = (|r|^2 - G) / (m - p),
//
// make G / s_u^2 a number of mean p and variance 2 p (1 + p / (m - p)) nearly. If it
// exceeds the mean by no more than two deviations, what the richer model could gain on
// as many frames is some two deviations of noise, 2 sqrt(2 p); what the errors of its p
// parameters cost in a forecast is about p per as many frames. So its forecast would
// not be better, and the fit, the longest of all by far, can be left out. (Rao, Large
// sample tests of statistical hypotheses, 1948.)
//
// Noise that neighbouring frames share, and anything systematic, make G larger: the fit
// is then made and its forecast decides.
#ifndef DPE_ESTIMATION_SCORE_TEST_H_
#define DPE_ESTIMATION_SCORE_TEST_H_

#include <vector>

#include "dpe/estimation/estimator.h"
#include "stop_control.h"

namespace dpe {

struct ScoreTest {
  bool ok = false;      // false: could not be computed; nothing follows
  int directions = 0;   // p
  double excess = 0.0;  // of G / s_u^2 over p, in standard deviations

  // True if the richer model is not worth a fit.
  bool NothingToGain() const;
};

// @param captures  in scenes of the richer model's modes, with the simpler fit's
// values;
//                  all frames are used
ScoreTest TestScore(const std::vector<CapturedMotion>& captures,
                    const EstimatorOptions& options, StopControl* stop);

}  // namespace dpe

#endif  // DPE_ESTIMATION_SCORE_TEST_H_
