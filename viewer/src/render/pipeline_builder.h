// A graphics pipeline from what differs between ours.
#ifndef DPE_VIEWER_RENDER_PIPELINE_BUILDER_H_
#define DPE_VIEWER_RENDER_PIPELINE_BUILDER_H_

#include <vulkan/vulkan.h>

#include <cstddef>
#include <cstdint>
#include <vector>

#include "render/render_passes.h"
#include "vk/device.h"
#include "vk/handle.h"

namespace dpe::viewer {

// SPIR-V, as arrays in the headers made of shaders/.
struct ShaderCode {
  ShaderCode() = default;
  template <std::size_t words>
  ShaderCode(const std::uint32_t (&code)[words])  // NOLINT: stands for the array
      : words_begin(code), bytes(sizeof(code)) {}

  const std::uint32_t* words_begin = nullptr;
  std::size_t bytes = 0;
};

struct PipelineDescription {
  ShaderCode vertex_shader;
  ShaderCode fragment_shader;
  std::vector<VkVertexInputBindingDescription> bindings;
  std::vector<VkVertexInputAttributeDescription> attributes;
  VkPrimitiveTopology topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_STRIP;
  bool depth_test = true;   // and write
  bool depth_bias = false;  // set while drawing
};

// For the scene's pass; viewport and scissor are set while drawing. Both sides of
// triangles are drawn, and blended by opacity.
vk::PipelineHandle MakePipeline(const vk::Device& device, const RenderPasses& passes,
                                VkPipelineLayout layout,
                                const PipelineDescription& description);

}  // namespace dpe::viewer

#endif  // DPE_VIEWER_RENDER_PIPELINE_BUILDER_H_
