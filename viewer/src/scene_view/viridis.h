// The colour map "viridis": equal steps of the value look equally large, it grows
// lighter all the way, and those who do not tell red from green read it as well
// (S. van der Walt and N. Smith, https://bids.github.io/colormap; public domain, CC0).
#ifndef DPE_VIEWER_SCENE_VIEW_VIRIDIS_H_
#define DPE_VIEWER_SCENE_VIEW_VIRIDIS_H_

#include <glm/vec3.hpp>

namespace dpe::viewer {

// sRGB for t in 0..1; beyond, the colour at the end.
glm::vec3 ViridisSrgb(float t);

glm::vec3 LinearFromSrgb(const glm::vec3& srgb);

}  // namespace dpe::viewer

#endif  // DPE_VIEWER_SCENE_VIEW_VIRIDIS_H_
