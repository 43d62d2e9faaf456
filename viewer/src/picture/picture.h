// What a picture of a scene consists of: plain data, without Vulkan.
//
// What moves (playback, simulation) makes pictures, the renderer draws them. World
// coordinates are those of scenes: metres, y up, right-handed.
#ifndef DPE_VIEWER_PICTURE_PICTURE_H_
#define DPE_VIEWER_PICTURE_PICTURE_H_

#include <cstdint>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <memory>
#include <vector>

namespace dpe::viewer {

// Which vertices a surface's triangles have. Pictures share it, so that the renderer
// uploads indices only when it is another one.
struct Topology {
  std::vector<std::uint32_t> triangles;  // triples, counter-clockwise seen from outside
  // 0, 1 or 2 per vertex, all three of them in each triangle, which is how the renderer
  // knows what is near an edge. Empty: edges cannot be drawn. See ColorCorners.
  std::vector<std::uint32_t> corners;
};

// A shaded surface, seen from both sides.
struct Surface {
  std::shared_ptr<const Topology> topology;
  std::vector<glm::vec3> positions;
  std::vector<glm::vec3> normals;  // unit length, one per vertex
  std::vector<glm::vec4> colors;   // linear RGBA, one per vertex
  // Edges of triangles, as a part of the surface: they cost next to nothing, and fade
  // where they lie so close that nothing else would be seen.
  glm::vec4 edge_color{0.0f, 0.0f, 0.0f, 1.0f};  // linear RGBA
  float edge_width = 0.0f;                       // pixels; 0: none
  // Whether lines of the picture lie along the surface and shall be seen: it is pushed
  // back a little then, so much where it is steep that what is behind may show at
  // folds.
  bool under_lines = true;
};

// Line segments: vertices 2i and 2i + 1 are joined.
struct Lines {
  std::vector<glm::vec3> positions;
  std::vector<glm::vec4> colors;  // linear RGBA, one per vertex
  float width = 1.0f;             // pixels
  bool on_top = false;            // drawn without a depth test
};

// Round marks of a size on the screen, such as fixed vertices.
struct Points {
  std::vector<glm::vec3> positions;
  glm::vec4 color = {1, 1, 1, 1};
  float size = 6.0f;  // pixels
};

struct Camera {
  glm::mat4 view{1.0f};        // world to camera, right-handed, looking along -z
  glm::mat4 projection{1.0f};  // camera to clip, Vulkan's depth 0..1, y down
  glm::vec3 position{0.0f};    // m
};

struct Picture {
  Camera camera;
  glm::vec3 light_direction{0.3f, 1.0f, 0.5f};  // towards the light
  // Linear, as all colours.
  glm::vec4 background{0.08f, 0.09f, 0.11f, 1.0f};
  std::vector<Surface> surfaces;
  std::vector<Lines> lines;
  std::vector<Points> points;
};

}  // namespace dpe::viewer

#endif  // DPE_VIEWER_PICTURE_PICTURE_H_
