// Whether a picture's arrays fit together.
#ifndef DPE_VIEWER_RENDER_PICTURE_CHECKS_H_
#define DPE_VIEWER_RENDER_PICTURE_CHECKS_H_

#include <cstddef>

#include "picture/picture.h"

namespace dpe::viewer {

// True if there is no triangle to draw.
bool IsEmpty(const Surface& surface);

// Throws std::invalid_argument that names what does not fit. Does not look into the
// triangles, which would take time in every frame: see VerticesNeeded.
void CheckPicture(const Picture& picture);

// The number of vertices that the triangles need. Throws std::invalid_argument if the
// last triangle is not complete.
std::size_t VerticesNeeded(const Topology& topology);

}  // namespace dpe::viewer

#endif  // DPE_VIEWER_RENDER_PICTURE_CHECKS_H_
