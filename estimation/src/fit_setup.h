// What a fit is set up from: the captures without what it must not know, their frames,
// and how small an error is no error.
#ifndef DPE_ESTIMATION_FIT_SETUP_H_
#define DPE_ESTIMATION_FIT_SETUP_H_

#include <string>
#include <vector>

#include "dpe/engine/scene.h"
#include "dpe/estimation/observations.h"

namespace dpe {

// One capture as it was given to the estimator: pointers to what the caller owns.
struct CaptureView {
  const Scene* scene = nullptr;
  const Observations* observations = nullptr;
  std::string name;  // in messages
};

// One capture as a fit sees it.
struct FitCapture {
  Scene blank;  // the scene without its values of what is estimated
  int num_frames = 0;
  Observations observations;  // of these frames
};

// The scene without its values of what is estimated, so that nothing that is computed
// from it can know them.
Scene WithoutEstimatedValues(const Scene& scene);

// @param asked_for  <= 0: as many as were observed
// @throws SceneError if nothing is estimated, or there are not as many frames
int NumFramesToFit(const Scene& scene, const Observations& observations, int asked_for);

// The captures without what a fit must not know, cut to the frames that it is to fit:
// with several, as many as asked for of those that have as many, all of the others.
//
// @param asked_for  <= 0: as many as were observed
// @throws SceneError for what NumFramesToFit refuses, and naming the captures if they
//         are not of the same cloths (RequireSameCloths), if one shows nothing that a
//         parameter moves, or if the noise of one is known and that of another is not
std::vector<FitCapture> PrepareCaptures(const std::vector<CaptureView>& captures,
                                        int asked_for);

// The captures over at most their first `num_frames` frames.
std::vector<FitCapture> CutCaptures(const std::vector<FitCapture>& captures,
                                    int num_frames);

// What the captures' fits simulate: their scenes, which must outlive the result.
std::vector<const Scene*> ScenesOf(const std::vector<FitCapture>& captures);

// Frames of the longest capture.
int MostFrames(const std::vector<FitCapture>& captures);

// What was observed in `num_frames` frames from `first` on, which becomes frame 0.
Observations CutFrames(const Observations& observations, int first, int num_frames);

// True if the noise of what is observed is known (MakePositionCosts sees to it that
// this holds for all observations or for none).
bool NoiseIsKnown(const Scene& scene, const Observations& observations);

// The cost of position residuals if every observation were `rms` (m) off.
double CostOfRms(const Scene& scene, const Observations& observations, double rms);

}  // namespace dpe

#endif  // DPE_ESTIMATION_FIT_SETUP_H_
