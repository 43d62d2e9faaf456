// A picture of a cloth that looks different from everywhere, for tests of drawing.
#ifndef DPE_TESTS_VIEWER_CLOTH_PICTURE_H_
#define DPE_TESTS_VIEWER_CLOTH_PICTURE_H_

#include "picture/picture.h"

namespace dpe::viewer {

// A camera at `eye` that looks at `target`, y up, 45 degrees from bottom to top.
// @param aspect  width by height
Camera LookAt(const glm::vec3& eye, const glm::vec3& target, float aspect);

// A wavy sheet of 2 m by 1.5 m with side x side vertices, reddish in x and greenish in
// y, hung up so that a camera on the side of +z sees front and, where a corner is
// folded over, back.
Surface WavySheet(int side);

// The triangles' edges as segments.
Lines Wireframe(const Surface& surface, const glm::vec4& color, float width);

// Normals from the triangles.
std::vector<glm::vec3> Normals(const std::vector<glm::vec3>& positions,
                               const std::vector<std::uint32_t>& triangles);

// The sheet with edges, two fixed vertices, a ground grid and axes on top.
Picture ClothPicture(int side, float aspect);

}  // namespace dpe::viewer

#endif  // DPE_TESTS_VIEWER_CLOTH_PICTURE_H_
