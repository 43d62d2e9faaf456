// What a fit is set up from: the scene without what it must not know, the frames, and
// how costs translate to RMS errors.
#ifndef DPE_ESTIMATION_FIT_SETUP_H_
#define DPE_ESTIMATION_FIT_SETUP_H_

#include "dpe/engine/scene.h"
#include "dpe/engine/simulator.h"
#include "dpe/estimation/observations.h"

namespace dpe {

// The scene without its values of what is estimated, so that nothing that is computed
// from it can know them.
Scene WithoutEstimatedValues(const Scene& scene);

// @param asked_for  <= 0: as many as were observed
// @throws SceneError if nothing is estimated, or there are not as many frames
int NumFramesToFit(const Scene& scene, const Observations& observations, int asked_for);

Observations FirstFrames(const Observations& observations, int num_frames);

// Translates position costs (1/2 sum of squares over free vertices after frame 0) to
// the RMS error over everything observed, in which fixed vertices and frame 0 count
// too.
class RmsScale {
 public:
  // Counts the objects that `simulator` simulates.
  RmsScale(const Simulator& simulator, const Observations& observations);

  double Rms(double cost) const;  // m
  // The cost at which free vertices alone contribute `rms` (m).
  double CostOf(double rms) const { return 0.5 * rms * rms * num_positions_; }

 private:
  double num_positions_ = 0.0;
  double constant_square_sum_ = 0.0;  // m^2, of what no parameter moves
};

}  // namespace dpe

#endif  // DPE_ESTIMATION_FIT_SETUP_H_
