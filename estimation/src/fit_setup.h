// What a fit is set up from: the scene without what it must not know, the frames, and
// how small an error is no error.
#ifndef DPE_ESTIMATION_FIT_SETUP_H_
#define DPE_ESTIMATION_FIT_SETUP_H_

#include "dpe/engine/scene.h"
#include "dpe/estimation/observations.h"

namespace dpe {

// The scene without its values of what is estimated, so that nothing that is computed
// from it can know them.
Scene WithoutEstimatedValues(const Scene& scene);

// @param asked_for  <= 0: as many as were observed
// @throws SceneError if nothing is estimated, or there are not as many frames
int NumFramesToFit(const Scene& scene, const Observations& observations, int asked_for);

Observations FirstFrames(const Observations& observations, int num_frames);

// True if the noise of what is observed is known (MakePositionCosts sees to it that
// this holds for all observations or for none).
bool NoiseIsKnown(const Scene& scene, const Observations& observations);

// The cost of position residuals if every observation were `rms` (m) off.
double CostOfRms(const Scene& scene, const Observations& observations, double rms);

}  // namespace dpe

#endif  // DPE_ESTIMATION_FIT_SETUP_H_
