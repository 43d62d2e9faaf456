// What several rollouts that are fitted together are given as.
#ifndef DPE_ESTIMATION_TRAJECTORY_SEGMENT_H_
#define DPE_ESTIMATION_TRAJECTORY_SEGMENT_H_

#include "dpe/engine/scene.h"
#include "dpe/estimation/trajectory_cost.h"

namespace dpe {

// One rollout: a scene, and costs on the states that it passes through. It is rolled
// out for as many frames as the costs read. See joint_layout.h for what segments share.
struct TrajectorySegment {
  Scene scene;
  TrajectoryCosts costs;
};

// Asks that one segment begin where another has got to: for every coordinate of a free
// vertex whose initial position and velocity are estimated in segment `to`, the
// residuals
//   position_weight (x_from(frame) - x_to(0))
//   velocity_weight (v_from(frame) - v_to(0)).
// They follow the costs of segment `from`, one further cost.
struct SegmentLink {
  int from = 0;
  int frame = 0;  // of segment `from`
  int to = 1;
  double position_weight = 1.0;  // 1/m, if residuals are numbers
  double velocity_weight = 1.0;  // s/m
};

}  // namespace dpe

#endif  // DPE_ESTIMATION_TRAJECTORY_SEGMENT_H_
