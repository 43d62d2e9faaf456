// Standard deviations out of an estimation's report.
#ifndef DPE_VIEWER_SCENE_VIEW_DEVIATIONS_IO_H_
#define DPE_VIEWER_SCENE_VIEW_DEVIATIONS_IO_H_

#include <string>

#include "dpe/engine/scene.h"
#include "scene_view/quantities.h"

namespace dpe::viewer {

// Reads report.json of estimate_cloth, spread over springs and vertices.
// @param scene  the estimated scene
// @throws SceneError naming the file and what is wrong: not a report, one without
//         standard deviations (and why), or of another scene
Deviations ReadDeviations(const std::string& path, const Scene& scene);

}  // namespace dpe::viewer

#endif  // DPE_VIEWER_SCENE_VIEW_DEVIATIONS_IO_H_
