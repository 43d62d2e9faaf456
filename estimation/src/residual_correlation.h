// Whether what a fit leaves over is noise: noise knows nothing of the frame before.
#ifndef DPE_ESTIMATION_RESIDUAL_CORRELATION_H_
#define DPE_ESTIMATION_RESIDUAL_CORRELATION_H_

#include "dpe/engine/trajectory.h"
#include "dpe/estimation/observations.h"

namespace dpe {

// Of the position errors e of what is observed, with pairs (a, b) of one vertex at
// successive frames or of successive samples of one marker:
//
//   rho = sum e_a . e_b / sum (|e_a|^2 + |e_b|^2) / 2,
//
// the autocorrelation at lag one. Noise that is independent from frame to frame makes
// it 0 to within 1 / sqrt(number of coordinates); errors of the model, which last, make
// it nearly 1.
struct ResidualCorrelation {
  double products = 0.0, squares = 0.0;  // the two sums, m^2
  long num_pairs = 0;                    // of coordinates

  double rho() const { return squares > 0.0 ? products / squares : 0.0; }
};

// Adds the pairs of one motion.
// @param num_frames  of the trajectory, to compare
void CorrelateResiduals(const Trajectory& trajectory, const Observations& observations,
                        int num_frames, ResidualCorrelation* correlation);

}  // namespace dpe

#endif  // DPE_ESTIMATION_RESIDUAL_CORRELATION_H_
