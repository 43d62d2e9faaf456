// The state of a cloth at a frame, from what was observed there and what a rollout
// says.
//
// With observed vertices i at x_i, fixed ones on their paths, and a base shape b - the
// rollout's, or the cloth's initial one where that is nearer to what was observed -
//   x_j = b_j + sum_i w_ij (x_i - b_i) / sum_i w_ij,   w_ij = 1 / |X_i - X_j|^2
// for the vertices j that were not observed, X being the initial shape (Shepard, A
// two-dimensional interpolation function for irregularly-spaced data, 1968): what was
// observed is kept, and its neighbours go along. Velocities likewise, where an observed
// one is the difference to the frame before.
#ifndef DPE_ESTIMATION_STATE_GUESS_H_
#define DPE_ESTIMATION_STATE_GUESS_H_

#include <Eigen/Core>

#include "dpe/engine/scene.h"
#include "dpe/estimation/observations.h"

namespace dpe {

struct StateGuess {
  Eigen::VectorXd position;  // 3N, m
  Eigen::VectorXd velocity;  // 3N, m/s; zero at fixed vertices
};

// @param rollout_position, rollout_velocity  3N, at that frame; NaN: there is none
// @param frame                               at least 1
StateGuess GuessState(const Scene& scene, int object, const Observations& observations,
                      const Eigen::VectorXd& rollout_position,
                      const Eigen::VectorXd& rollout_velocity, int frame);

}  // namespace dpe

#endif  // DPE_ESTIMATION_STATE_GUESS_H_
