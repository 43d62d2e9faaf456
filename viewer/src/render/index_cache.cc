#include "render/index_cache.h"

#include <algorithm>
#include <stdexcept>

#include "render/picture_checks.h"

namespace dpe::viewer {
namespace {

void RequireVertices(const Surface& surface, std::size_t vertices) {
  if (surface.positions.size() < vertices) {
    throw std::invalid_argument(
        "Picture: a surface has triangles of vertices that do "
        "not exist");
  }
}

}  // namespace

const IndexCache::Entry* IndexCache::Find(const Topology& topology) const {
  for (const Entry& entry : entries_) {
    // A new topology may be where one that ended was: the weak pointer knows.
    if (entry.topology.lock().get() == &topology) return &entry;
  }
  return nullptr;
}

VkDeviceSize IndexCache::BytesToUpload(const Topology& topology) const {
  return Find(topology) != nullptr
             ? 0
             : FrameArena::Padded(CornersOffset(topology)) +
                   FrameArena::Padded(topology.corners.size() * sizeof(std::uint32_t));
}

IndexCache::Indices IndexCache::Get(const vk::Device& device, VkCommandBuffer commands,
                                    FrameArena* arena, const Surface& surface) {
  const std::shared_ptr<const Topology>& topology = surface.topology;
  if (const Entry* entry = Find(*topology)) {
    RequireVertices(surface, entry->vertices);
    return entry->indices;
  }
  const std::size_t vertices = VerticesNeeded(*topology);
  RequireVertices(surface, vertices);
  const VkDeviceSize bytes = CornersOffset(*topology);
  const VkDeviceSize corner_bytes = topology->corners.size() * sizeof(std::uint32_t);
  auto indices = std::make_shared<vk::Buffer>(device, bytes + corner_bytes,
                                              VK_BUFFER_USAGE_INDEX_BUFFER_BIT |
                                                  VK_BUFFER_USAGE_VERTEX_BUFFER_BIT |
                                                  VK_BUFFER_USAGE_TRANSFER_DST_BIT,
                                              VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT);
  const VkBufferCopy regions[] = {{arena->Put(topology->triangles), 0, bytes},
                                  {arena->Put(topology->corners), bytes, corner_bytes}};
  vkCmdCopyBuffer(commands, arena->buffer(), indices->get(), corner_bytes > 0 ? 2 : 1,
                  regions);
  VkMemoryBarrier written{VK_STRUCTURE_TYPE_MEMORY_BARRIER};
  written.srcAccessMask = VK_ACCESS_TRANSFER_WRITE_BIT;
  written.dstAccessMask =
      VK_ACCESS_INDEX_READ_BIT | VK_ACCESS_VERTEX_ATTRIBUTE_READ_BIT;
  vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_TRANSFER_BIT,
                       VK_PIPELINE_STAGE_VERTEX_INPUT_BIT, 0, 1, &written, 0, nullptr,
                       0, nullptr);
  entries_.push_back({topology, vertices, indices});
  return indices;
}

void IndexCache::Tidy() {
  entries_.erase(
      std::remove_if(entries_.begin(), entries_.end(),
                     [](const Entry& entry) { return entry.topology.expired(); }),
      entries_.end());
}

}  // namespace dpe::viewer
