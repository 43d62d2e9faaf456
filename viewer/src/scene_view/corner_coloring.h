// Numbers the corners of triangles 0, 1 and 2, so that each triangle has all three.
//
// With them a vertex carries the barycentric coordinate that is 1 there, and vertices
// are still shared by triangles. Across an edge of two triangles the third corners have
// the same number, so that one triangle decides about all that hang together by edges.
// Going around a vertex of an odd number of triangles this does not come out: such
// vertices are drawn as several, one per number.
#ifndef DPE_VIEWER_SCENE_VIEW_CORNER_COLORING_H_
#define DPE_VIEWER_SCENE_VIEW_CORNER_COLORING_H_

#include <array>
#include <cstdint>
#include <vector>

namespace dpe::viewer {

struct CornerColoring {
  // As those given, but of vertices and their copies, which are numbered on.
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<std::uint32_t> corners;  // 0, 1 or 2; vertices first, then copies
  std::vector<int> copies;             // of which vertex
};

// @param triangles  of vertices from 0 to num_vertices - 1
CornerColoring ColorCorners(const std::vector<std::array<int, 3>>& triangles,
                            int num_vertices);

}  // namespace dpe::viewer

#endif  // DPE_VIEWER_SCENE_VIEW_CORNER_COLORING_H_
