// Integrates one object over many frames.
#ifndef DPE_ENGINE_OBJECT_ROLLOUT_H_
#define DPE_ENGINE_OBJECT_ROLLOUT_H_

#include <cstddef>

#include "dpe/engine/simulator.h"
#include "object_system.h"
#include "rollout_tape.h"

namespace dpe {

// Fills the object's frames of `trajectory` (allocated, NaN) and, if not null, `tape`,
// whose solvers may take up to `solver_bytes`.
RolloutStatus RollOutObject(const Scene& scene, const SimulatorOptions& options,
                            int object, int num_frames, size_t solver_bytes,
                            ObjectSystem* system, ObjectTape* tape,
                            Trajectory* trajectory);

}  // namespace dpe

#endif  // DPE_ENGINE_OBJECT_ROLLOUT_H_
