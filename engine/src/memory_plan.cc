#include "memory_plan.h"

#include <algorithm>

namespace dpe {

MemoryPlan PlanMemory(std::size_t limit_bytes, int num_intervals, int steps_per_frame,
                      const std::vector<MemoryDemand>& objects) {
  std::size_t frame = 0, factor = 0;
  for (const MemoryDemand& demand : objects) {
    frame += demand.bytes_per_frame;
    factor += demand.bytes_per_factor;
  }
  MemoryPlan plan;
  const std::size_t intervals = std::max(num_intervals, 0);
  const std::size_t frames = frame > 0 ? std::min(intervals, limit_bytes / frame) : 0;
  plan.num_inner_frames = static_cast<int>(frames);
  if (factor > 0 && (frame == 0 || frames == intervals)) {
    plan.num_factors = static_cast<int>(
        std::min(intervals * steps_per_frame, (limit_bytes - frames * frame) / factor));
  }
  return plan;
}

}  // namespace dpe
