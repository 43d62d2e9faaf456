#include "render/picture_drawer.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "render/picture_checks.h"

namespace dpe::viewer {
namespace {

using Upload = PictureDrawer::Upload;

template <typename Item>
VkDeviceSize Bytes(const std::vector<Item>& items) {
  return FrameArena::Padded(items.size() * sizeof(Item));
}

VkDeviceSize BytesToUpload(const Picture& picture, const IndexCache& indices) {
  VkDeviceSize bytes = 0;
  for (const Surface& surface : picture.surfaces) {
    if (IsEmpty(surface)) continue;
    // A topology that several surfaces share counts for each: too much by a little.
    bytes += indices.BytesToUpload(*surface.topology) + Bytes(surface.positions) +
             Bytes(surface.normals) + Bytes(surface.colors);
  }
  for (const Lines& lines : picture.lines) {
    bytes += Bytes(lines.positions) + Bytes(lines.colors);
  }
  for (const Points& points : picture.points) bytes += Bytes(points.positions);
  return bytes;
}

SceneConstants Constants(const Picture& picture, VkExtent2D extent) {
  const glm::mat4& projection = picture.camera.projection;
  SceneConstants constants{};
  constants.view_projection = projection * picture.camera.view;
  constants.to_light = glm::normalize(picture.light_direction);
  constants.clip_z_per_z = projection[2][2];
  constants.eye = picture.camera.position;
  constants.clip_w_per_z = projection[2][3];
  constants.viewport = {extent.width, extent.height};
  constants.vertical_scale = std::abs(projection[1][1]);
  return constants;
}

void SetViewport(VkCommandBuffer commands, VkExtent2D extent) {
  const VkViewport viewport{
      0, 0, static_cast<float>(extent.width), static_cast<float>(extent.height), 0, 1};
  const VkRect2D scissor{{0, 0}, extent};
  vkCmdSetViewport(commands, 0, 1, &viewport);
  vkCmdSetScissor(commands, 0, 1, &scissor);
}

// Commands of one frame.
class Painter {
 public:
  Painter(VkCommandBuffer commands, const Pipelines& pipelines, const Upload& upload,
          const SceneConstants& constants)
      : commands_(commands),
        pipelines_(pipelines),
        upload_(upload),
        constants_(constants) {}

  void Surfaces(const std::vector<Surface>& surfaces) {
    for (std::size_t i = 0; i < surfaces.size(); ++i) {
      const Upload::Part& part = upload_.surfaces[i];
      if (!part.indices) continue;
      const Topology& topology = *surfaces[i].topology;
      const bool with_edges = surfaces[i].edge_width > 0.0f;
      constants_.pixels = surfaces[i].edge_width;
      constants_.color = surfaces[i].edge_color;
      Begin(pipelines_.surface(with_edges), part, 3);
      // Lines along the surface lie in front of it, whatever the slope.
      vkCmdSetDepthBias(commands_, 0.0f, 0.0f, surfaces[i].under_lines ? 1.5f : 0.0f);
      if (with_edges) {
        const VkBuffer buffer = part.indices->get();
        const VkDeviceSize offset = IndexCache::CornersOffset(topology);
        vkCmdBindVertexBuffers(commands_, 3, 1, &buffer, &offset);
      }
      vkCmdBindIndexBuffer(commands_, part.indices->get(), 0, VK_INDEX_TYPE_UINT32);
      vkCmdDrawIndexed(commands_, static_cast<std::uint32_t>(topology.triangles.size()),
                       1, 0, 0, 0);
    }
  }

  void AllLines(const std::vector<Lines>& lines, bool on_top) {
    for (std::size_t i = 0; i < lines.size(); ++i) {
      if (lines[i].on_top != on_top || lines[i].positions.empty()) continue;
      constants_.pixels = std::max(lines[i].width, 1.0f);
      Begin(pipelines_.line(on_top), upload_.lines[i], 2);
      DrawInstances(lines[i].positions.size() / 2);
    }
  }

  void AllPoints(const std::vector<Points>& points) {
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (points[i].positions.empty()) continue;
      constants_.pixels = points[i].size;
      constants_.color = points[i].color;
      Begin(pipelines_.point(), upload_.points[i], 1);
      DrawInstances(points[i].positions.size());
    }
  }

 private:
  void Begin(VkPipeline pipeline, const Upload::Part& part, std::uint32_t bindings) {
    vkCmdBindPipeline(commands_, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline);
    vkCmdPushConstants(commands_, pipelines_.layout(),
                       VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT, 0,
                       sizeof(constants_), &constants_);
    const VkBuffer buffer = upload_.arena.buffer();
    const VkBuffer buffers[] = {buffer, buffer, buffer};
    vkCmdBindVertexBuffers(commands_, 0, bindings, buffers, part.offsets);
  }

  void DrawInstances(std::size_t count) {
    vkCmdDraw(commands_, 4, static_cast<std::uint32_t>(count), 0, 0);
  }

  VkCommandBuffer commands_;
  const Pipelines& pipelines_;
  const Upload& upload_;
  SceneConstants constants_;
};

}  // namespace

PictureDrawer::PictureDrawer(const vk::Device& device, const RenderPasses& passes)
    : device_(device), pipelines_(device, passes) {}

void PictureDrawer::Prepare(VkCommandBuffer commands, const Picture& picture,
                            Upload* upload) {
  CheckPicture(picture);
  FrameArena& arena = upload->arena;
  arena.Restart(device_, BytesToUpload(picture, indices_));
  upload->surfaces.assign(picture.surfaces.size(), {});
  upload->lines.assign(picture.lines.size(), {});
  upload->points.assign(picture.points.size(), {});
  indices_.Tidy();
  for (std::size_t i = 0; i < picture.surfaces.size(); ++i) {
    const Surface& surface = picture.surfaces[i];
    if (IsEmpty(surface)) continue;
    Upload::Part& part = upload->surfaces[i];
    part.indices = indices_.Get(device_, commands, &arena, surface);
    part.offsets[0] = arena.Put(surface.positions);
    part.offsets[1] = arena.Put(surface.normals);
    part.offsets[2] = arena.Put(surface.colors);
  }
  for (std::size_t i = 0; i < picture.lines.size(); ++i) {
    upload->lines[i].offsets[0] = arena.Put(picture.lines[i].positions);
    upload->lines[i].offsets[1] = arena.Put(picture.lines[i].colors);
  }
  for (std::size_t i = 0; i < picture.points.size(); ++i) {
    upload->points[i].offsets[0] = arena.Put(picture.points[i].positions);
  }
}

void PictureDrawer::Draw(VkCommandBuffer commands, const Picture& picture,
                         const Upload& upload, VkExtent2D extent) const {
  SetViewport(commands, extent);
  Painter painter(commands, pipelines_, upload, Constants(picture, extent));
  painter.Surfaces(picture.surfaces);
  painter.AllLines(picture.lines, false);
  painter.AllPoints(picture.points);
  painter.AllLines(picture.lines, true);
}

}  // namespace dpe::viewer
