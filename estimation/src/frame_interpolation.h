// States between frames.
//
// A position at time t (in frames) is the cubic through the four nearest frames f_k,
//
//   x(t) = sum_k w_k x(f_k),   w_k = prod_{j != k} (t - f_j) / (f_k - f_j)
//
// (Lagrange), shifted inwards at both ends, of lower degree where there are fewer
// frames. It is linear in the states, so its derivative is the weights. Velocities are
// left out on purpose: those of the first-order methods are differences of positions
// over a step and would lower the order.
#ifndef DPE_ESTIMATION_FRAME_INTERPOLATION_H_
#define DPE_ESTIMATION_FRAME_INTERPOLATION_H_

#include <array>

namespace dpe {

struct FrameWeights {
  int first = 0;  // frames first ... first + count - 1
  int count = 0;  // 1 if the time is that of a frame
  std::array<double, 4> weights{};
};

// @param time        in frames, from 0 to num_frames - 1; within 1e-9 of a frame it is
//                    that frame
// @param num_frames  that there are, at least 1
FrameWeights InterpolateFrames(double time, int num_frames);

// True if a time lies in the first `num_frames` frames.
bool IsWithinFrames(double time, int num_frames);

}  // namespace dpe

#endif  // DPE_ESTIMATION_FRAME_INTERPOLATION_H_
