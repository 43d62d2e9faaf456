// Integrates one object over many frames.
#ifndef DPE_ENGINE_OBJECT_ROLLOUT_H_
#define DPE_ENGINE_OBJECT_ROLLOUT_H_

#include "dpe/engine/simulator.h"
#include "memory_plan.h"
#include "object_system.h"
#include "rollout_tape.h"

namespace dpe {

// What a rollout of one object could keep.
MemoryDemand DemandOf(const Scene& scene, const SimulatorOptions& options,
                      const ObjectSystem& system);

// Fills the object's frames of `trajectory` (allocated, NaN) and, if not null, `tape`
// (its pool is set), which keeps what the plan says.
RolloutStatus RollOutObject(const Scene& scene, const SimulatorOptions& options,
                            int object, const MemoryPlan& plan, ObjectSystem* system,
                            ObjectTape* tape, Trajectory* trajectory);

}  // namespace dpe

#endif  // DPE_ENGINE_OBJECT_ROLLOUT_H_
