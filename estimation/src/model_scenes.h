// The scenes of a fit's captures as one model: what it estimates, with which values.
#ifndef DPE_ESTIMATION_MODEL_SCENES_H_
#define DPE_ESTIMATION_MODEL_SCENES_H_

#include <vector>

#include "dpe/engine/parameters.h"
#include "dpe/engine/scene.h"
#include "dpe/estimation/estimator.h"

namespace dpe {

using Captures = std::vector<CapturedMotion>;
using Scenes = std::vector<Scene>;  // one per capture

Scenes ScenesOf(const Captures& captures);
Scenes FittedScenes(const EstimatorSummary& summary);

// Sets an object's stiffness mode in all of them.
void SetMode(int object, ParameterMode mode, Scenes* scenes);

// The captures in these scenes: their modes and values.
Captures In(const Scenes& scenes, Captures captures);

// The captures in their own scenes with the stiffness modes of `modes`.
Captures WithModesOf(const Scenes& modes, Captures captures);

// Of all that is estimated.
ParameterLayout LayoutOf(const Scenes& scenes);

// True if something is estimated with one unknown per element.
bool HasElements(const Scenes& scenes);
// The same of one quantity. @param object  -1: of any
bool HasElements(const Scenes& scenes, ParameterKind kind, int object);

}  // namespace dpe

#endif  // DPE_ESTIMATION_MODEL_SCENES_H_
