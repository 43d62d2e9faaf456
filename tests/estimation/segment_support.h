// Two motions of one cloth, for tests of fits to several.
#ifndef DPE_TESTS_ESTIMATION_SEGMENT_SUPPORT_H_
#define DPE_TESTS_ESTIMATION_SEGMENT_SUPPORT_H_

#include <utility>
#include <vector>

#include "dpe/engine/cloth_builder.h"
#include "dpe/engine/simulator.h"
#include "dpe/estimation/trajectory_segment.h"
#include "support/test_scenes.h"

namespace dpe::test {

// A cloth of 4 x 4 vertices, perturbed: hanging from one side in a wind, and the same
// from two opposite corners (of which only 12 is fixed in the first too), tilted,
// moving from the start and on another time step. The side fixes 12 to 15, the corners
// 3 and 12.
inline std::vector<Scene> SideAndCorners() {
  Scene side = MakeDerivativeScene("side", 4);
  Perturb(3, &side);
  Scene corners = side;
  ClothObject& cloth = corners.objects[0];
  UnpinAll(&cloth);
  PinVertices({3, 12}, &cloth);
  cloth.velocities.setConstant(0.2);
  for (int v : {3, 12}) cloth.velocities.segment<3>(3 * v).setZero();
  corners.gravity = {1.0, -9.0, 2.0};
  corners.wind = {0.5, 1.0, 1.5};
  corners.delta = 0.015;
  corners.steps_per_frame = 2;
  return {side, corners};
}

// Position costs of every scene on the motion of a perturbed one.
inline std::vector<TrajectorySegment> SegmentsOf(const std::vector<Scene>& scenes,
                                                 int num_frames) {
  std::vector<TrajectorySegment> segments;
  for (const Scene& scene : scenes) {
    Scene other = scene;
    Perturb(5, &other);
    // A frame more in every segment: they need not have the same number.
    const int frames = num_frames + static_cast<int>(segments.size());
    segments.push_back(
        {scene, MakePositionCosts(scene, ObserveAll(Simulator(other).Simulate(frames)),
                                  frames)});
  }
  return segments;
}

}  // namespace dpe::test

#endif  // DPE_TESTS_ESTIMATION_SEGMENT_SUPPORT_H_
