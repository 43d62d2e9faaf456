#include "render/pipeline_builder.h"

#include "vk/check.h"

namespace dpe::viewer {
namespace {

vk::ShaderModuleHandle MakeShader(const vk::Device& device, const ShaderCode& code) {
  VkShaderModuleCreateInfo info{VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO};
  info.codeSize = code.bytes;
  info.pCode = code.words_begin;
  VkShaderModule shader = VK_NULL_HANDLE;
  vk::Check(vkCreateShaderModule(device.get(), &info, nullptr, &shader),
            "loading a shader");
  return {device.get(), shader};
}

VkPipelineShaderStageCreateInfo Stage(VkShaderStageFlagBits stage,
                                      VkShaderModule shader) {
  VkPipelineShaderStageCreateInfo info{
      VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO};
  info.stage = stage;
  info.module = shader;
  info.pName = "main";
  return info;
}

VkPipelineVertexInputStateCreateInfo VertexInput(
    const PipelineDescription& description) {
  VkPipelineVertexInputStateCreateInfo info{
      VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO};
  info.vertexBindingDescriptionCount =
      static_cast<std::uint32_t>(description.bindings.size());
  info.pVertexBindingDescriptions = description.bindings.data();
  info.vertexAttributeDescriptionCount =
      static_cast<std::uint32_t>(description.attributes.size());
  info.pVertexAttributeDescriptions = description.attributes.data();
  return info;
}

VkPipelineRasterizationStateCreateInfo Rasterization(bool depth_bias) {
  VkPipelineRasterizationStateCreateInfo info{
      VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO};
  info.polygonMode = VK_POLYGON_MODE_FILL;
  info.cullMode = VK_CULL_MODE_NONE;
  // Camera::projection points y down as Vulkan's framebuffers do, so that what is
  // counter-clockwise to the eye is so to Vulkan.
  info.frontFace = VK_FRONT_FACE_COUNTER_CLOCKWISE;
  info.depthBiasEnable = depth_bias;
  info.lineWidth = 1.0f;
  return info;
}

VkPipelineDepthStencilStateCreateInfo Depth(bool test) {
  VkPipelineDepthStencilStateCreateInfo info{
      VK_STRUCTURE_TYPE_PIPELINE_DEPTH_STENCIL_STATE_CREATE_INFO};
  info.depthTestEnable = test;
  info.depthWriteEnable = test;
  info.depthCompareOp = VK_COMPARE_OP_LESS_OR_EQUAL;
  return info;
}

VkPipelineColorBlendAttachmentState Blend() {
  VkPipelineColorBlendAttachmentState state{};
  state.blendEnable = VK_TRUE;
  state.srcColorBlendFactor = VK_BLEND_FACTOR_SRC_ALPHA;
  state.dstColorBlendFactor = VK_BLEND_FACTOR_ONE_MINUS_SRC_ALPHA;
  state.colorBlendOp = VK_BLEND_OP_ADD;
  state.srcAlphaBlendFactor = VK_BLEND_FACTOR_ONE;
  state.dstAlphaBlendFactor = VK_BLEND_FACTOR_ONE_MINUS_SRC_ALPHA;
  state.alphaBlendOp = VK_BLEND_OP_ADD;
  state.colorWriteMask = VK_COLOR_COMPONENT_R_BIT | VK_COLOR_COMPONENT_G_BIT |
                         VK_COLOR_COMPONENT_B_BIT | VK_COLOR_COMPONENT_A_BIT;
  return state;
}

}  // namespace

vk::PipelineHandle MakePipeline(const vk::Device& device, const RenderPasses& passes,
                                VkPipelineLayout layout,
                                const PipelineDescription& description) {
  const vk::ShaderModuleHandle vertex = MakeShader(device, description.vertex_shader);
  const vk::ShaderModuleHandle fragment =
      MakeShader(device, description.fragment_shader);
  const VkPipelineShaderStageCreateInfo stages[] = {
      Stage(VK_SHADER_STAGE_VERTEX_BIT, vertex.get()),
      Stage(VK_SHADER_STAGE_FRAGMENT_BIT, fragment.get())};
  const auto vertex_input = VertexInput(description);
  VkPipelineInputAssemblyStateCreateInfo assembly{
      VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO};
  assembly.topology = description.topology;
  VkPipelineViewportStateCreateInfo viewport{
      VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO};
  viewport.viewportCount = 1;
  viewport.scissorCount = 1;
  const auto rasterization = Rasterization(description.depth_bias);
  VkPipelineMultisampleStateCreateInfo multisample{
      VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO};
  multisample.rasterizationSamples = passes.samples();
  const auto depth = Depth(description.depth_test);
  const VkPipelineColorBlendAttachmentState blend = Blend();
  VkPipelineColorBlendStateCreateInfo blending{
      VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO};
  blending.attachmentCount = 1;
  blending.pAttachments = &blend;
  const VkDynamicState dynamic_states[] = {
      VK_DYNAMIC_STATE_VIEWPORT, VK_DYNAMIC_STATE_SCISSOR, VK_DYNAMIC_STATE_DEPTH_BIAS};
  VkPipelineDynamicStateCreateInfo dynamic{
      VK_STRUCTURE_TYPE_PIPELINE_DYNAMIC_STATE_CREATE_INFO};
  dynamic.dynamicStateCount = description.depth_bias ? 3 : 2;
  dynamic.pDynamicStates = dynamic_states;

  VkGraphicsPipelineCreateInfo info{VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO};
  info.stageCount = 2;
  info.pStages = stages;
  info.pVertexInputState = &vertex_input;
  info.pInputAssemblyState = &assembly;
  info.pViewportState = &viewport;
  info.pRasterizationState = &rasterization;
  info.pMultisampleState = &multisample;
  info.pDepthStencilState = &depth;
  info.pColorBlendState = &blending;
  info.pDynamicState = &dynamic;
  info.layout = layout;
  info.renderPass = passes.scene();
  VkPipeline pipeline = VK_NULL_HANDLE;
  vk::Check(vkCreateGraphicsPipelines(device.get(), VK_NULL_HANDLE, 1, &info, nullptr,
                                      &pipeline),
            "creating a pipeline");
  return {device.get(), pipeline};
}

}  // namespace dpe::viewer
