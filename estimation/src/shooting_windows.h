// The windows of multiple shooting: scenes, observations and links of the pieces of one
// motion.
#ifndef DPE_ESTIMATION_SHOOTING_WINDOWS_H_
#define DPE_ESTIMATION_SHOOTING_WINDOWS_H_

#include <vector>

#include "dpe/engine/scene.h"
#include "dpe/engine/trajectory.h"
#include "dpe/estimation/observations.h"
#include "dpe/estimation/trajectory_segment.h"

namespace dpe {

struct ShootingWindow {
  int first_frame = 0;
  int num_frames = 0;  // its first and last frame included; the last is the next one's
                       // first
  // Starts at first_frame; of windows after the first, initial positions and velocities
  // of what is simulated are estimated.
  Scene scene;
  // From first_frame on; of windows after the first without that frame itself, which
  // the window before has.
  Observations observations;
};

// Cuts a motion into windows of `window_frames` frame lengths, the last one shorter
// where it has to be, but by no more than half: else it joins the one before.
//
// @param rollout  states to start from where nothing was observed (state_guess.h);
//                 frames after a failure are NaN
std::vector<ShootingWindow> CutIntoWindows(const Scene& scene,
                                           const Observations& observations,
                                           const Trajectory& rollout, int num_frames,
                                           int window_frames);

// One link from each window to the next.
std::vector<SegmentLink> LinkWindows(const std::vector<ShootingWindow>& windows);

}  // namespace dpe

#endif  // DPE_ESTIMATION_SHOOTING_WINDOWS_H_
