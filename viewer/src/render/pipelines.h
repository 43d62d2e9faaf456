// How surfaces, lines and points become pixels.
#ifndef DPE_VIEWER_RENDER_PIPELINES_H_
#define DPE_VIEWER_RENDER_PIPELINES_H_

#include <vulkan/vulkan.h>

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>

#include "render/render_passes.h"
#include "vk/device.h"
#include "vk/handle.h"

namespace dpe::viewer {

// What the shaders are told with every drawing (shaders/scene.glsl says the same): the
// 128 bytes that every device has room for.
struct SceneConstants {
  glm::mat4 view_projection;
  glm::vec3 to_light;  // unit length
  // How clip z and w grow with the camera's z, that is towards the viewer: marks are
  // drawn nearer than what they mark.
  float clip_z_per_z;
  glm::vec3 eye;
  float clip_w_per_z;
  glm::vec2 viewport;    // pixels
  float pixels;          // width of lines and edges, size of points
  float vertical_scale;  // clip y per metre upwards, without its sign
  glm::vec4 color;       // of points and edges
};
static_assert(sizeof(SceneConstants) == 128);

// Vertices come in as they are in a Picture: one array per attribute. Lines and points
// are instances, which the vertex shader makes four corners of.
class Pipelines {
 public:
  Pipelines(const vk::Device& device, const RenderPasses& passes);

  VkPipelineLayout layout() const { return layout_.get(); }
  VkPipeline surface(bool with_edges) const {
    return with_edges ? surface_with_edges_.get() : surface_.get();
  }
  VkPipeline line(bool on_top) const {
    return on_top ? line_on_top_.get() : line_.get();
  }
  VkPipeline point() const { return point_.get(); }

 private:
  vk::PipelineLayoutHandle layout_;
  vk::PipelineHandle surface_;
  vk::PipelineHandle surface_with_edges_;
  vk::PipelineHandle line_;
  vk::PipelineHandle line_on_top_;
  vk::PipelineHandle point_;
};

}  // namespace dpe::viewer

#endif  // DPE_VIEWER_RENDER_PIPELINES_H_
