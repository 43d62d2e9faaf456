// The flags that say how a target (what was observed) is to be read: --target_scale,
// --target_up, --marker_map and the like, which mean the same wherever one is read.
//
// Whoever compiles target_flags.cc has them: a program that reads no targets leaves it
// out, and refuses the flags.
#ifndef DPE_TOOLS_SUPPORT_TARGET_TARGET_FLAGS_H_
#define DPE_TOOLS_SUPPORT_TARGET_TARGET_FLAGS_H_

#include "dpe/estimation/load_target.h"

namespace dpe::tools {

// What the flags say; TargetOptions::rest_shape is not among them.
// @throws SceneError naming the flag, its value and what is accepted
TargetOptions TargetFromFlags();

}  // namespace dpe::tools

#endif  // DPE_TOOLS_SUPPORT_TARGET_TARGET_FLAGS_H_
