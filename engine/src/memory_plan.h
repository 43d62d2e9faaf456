// What of a rollout is worth its memory. Derivative passes need, in reverse or in
// order, the states around every step and the factorised matrix of every step. Those at
// frames are in the trajectory, which is returned anyway: they are the checkpoints, and
// everything else can be made again from them. Beyond them a rollout keeps
//   1. the states inside frames, which save a pass from taking the steps of a frame
//      again: forces, assembly, factorisation and solve for two or four vectors;
//   2. then factorised matrices, which save assembly and factorisation alone and take
//      tens of vectors. Of an iterative solver none: what it would keep is the matrix.
//      That saves 3 to 5 % of a backward pass, and filling the memory costs a rollout
//      as much.
// Where not all fit, those of the first frames are kept: each saves the same, and every
// functional of the trajectory depends on the first steps, not every one on the last.
#ifndef DPE_ENGINE_MEMORY_PLAN_H_
#define DPE_ENGINE_MEMORY_PLAN_H_

#include <cstddef>
#include <vector>

namespace dpe {

// What one object would take. 0: the object has none of these.
struct MemoryDemand {
  std::size_t bytes_per_frame = 0;   // states inside a frame
  std::size_t bytes_per_factor = 0;  // a factorised step matrix
};

// What every object keeps.
struct MemoryPlan {
  int num_inner_frames = 0;  // frames whose inner states are kept
  int num_factors = 0;       // steps whose factorisations are kept
};

// @param num_intervals  frames to step to, the initial one not counted
MemoryPlan PlanMemory(std::size_t limit_bytes, int num_intervals, int steps_per_frame,
                      const std::vector<MemoryDemand>& objects);

}  // namespace dpe

#endif  // DPE_ENGINE_MEMORY_PLAN_H_
