#include "render/pipelines.h"

#include <glm/vec3.hpp>

#include "render/pipeline_builder.h"
#include "shaders/flat_frag.h"
#include "shaders/line_vert.h"
#include "shaders/point_frag.h"
#include "shaders/point_vert.h"
#include "shaders/surface_edges_frag.h"
#include "shaders/surface_edges_vert.h"
#include "shaders/surface_frag.h"
#include "shaders/surface_vert.h"
#include "vk/check.h"

namespace dpe::viewer {
namespace {

constexpr VkFormat kVec3 = VK_FORMAT_R32G32B32_SFLOAT;
constexpr VkFormat kVec4 = VK_FORMAT_R32G32B32A32_SFLOAT;
constexpr VkFormat kUint = VK_FORMAT_R32_UINT;
constexpr std::uint32_t kVec3Size = sizeof(glm::vec3);
constexpr std::uint32_t kVec4Size = sizeof(glm::vec4);

vk::PipelineLayoutHandle MakeLayout(const vk::Device& device) {
  const VkPushConstantRange range{
      VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT, 0,
      sizeof(SceneConstants)};
  VkPipelineLayoutCreateInfo info{VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO};
  info.pushConstantRangeCount = 1;
  info.pPushConstantRanges = &range;
  VkPipelineLayout layout = VK_NULL_HANDLE;
  vk::Check(vkCreatePipelineLayout(device.get(), &info, nullptr, &layout),
            "creating a pipeline layout");
  return {device.get(), layout};
}

PipelineDescription Surface(bool with_edges) {
  PipelineDescription description;
  description.vertex_shader =
      with_edges ? ShaderCode(surface_edges_vert) : ShaderCode(surface_vert);
  description.fragment_shader =
      with_edges ? ShaderCode(surface_edges_frag) : ShaderCode(surface_frag);
  description.bindings = {{0, kVec3Size, VK_VERTEX_INPUT_RATE_VERTEX},
                          {1, kVec3Size, VK_VERTEX_INPUT_RATE_VERTEX},
                          {2, kVec4Size, VK_VERTEX_INPUT_RATE_VERTEX}};
  description.attributes = {{0, 0, kVec3, 0}, {1, 1, kVec3, 0}, {2, 2, kVec4, 0}};
  if (with_edges) {
    description.bindings.push_back(
        {3, sizeof(std::uint32_t), VK_VERTEX_INPUT_RATE_VERTEX});
    description.attributes.push_back({3, 3, kUint, 0});
  }
  description.topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST;
  description.depth_bias = true;
  return description;
}

PipelineDescription Line(bool on_top) {
  PipelineDescription description;
  description.vertex_shader = line_vert;
  description.fragment_shader = flat_frag;
  description.bindings = {{0, 2 * kVec3Size, VK_VERTEX_INPUT_RATE_INSTANCE},
                          {1, 2 * kVec4Size, VK_VERTEX_INPUT_RATE_INSTANCE}};
  description.attributes = {{0, 0, kVec3, 0},
                            {1, 0, kVec3, kVec3Size},
                            {2, 1, kVec4, 0},
                            {3, 1, kVec4, kVec4Size}};
  description.depth_test = !on_top;
  return description;
}

PipelineDescription Point() {
  PipelineDescription description;
  description.vertex_shader = point_vert;
  description.fragment_shader = point_frag;
  description.bindings = {{0, kVec3Size, VK_VERTEX_INPUT_RATE_INSTANCE}};
  description.attributes = {{0, 0, kVec3, 0}};
  return description;
}

}  // namespace

Pipelines::Pipelines(const vk::Device& device, const RenderPasses& passes)
    : layout_(MakeLayout(device)),
      surface_(MakePipeline(device, passes, layout_.get(), Surface(false))),
      surface_with_edges_(MakePipeline(device, passes, layout_.get(), Surface(true))),
      line_(MakePipeline(device, passes, layout_.get(), Line(false))),
      line_on_top_(MakePipeline(device, passes, layout_.get(), Line(true))),
      point_(MakePipeline(device, passes, layout_.get(), Point())) {}

}  // namespace dpe::viewer
