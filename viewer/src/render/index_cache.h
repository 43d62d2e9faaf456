// Topologies in the device's own memory: indices of triangles and corners of vertices.
#ifndef DPE_VIEWER_RENDER_INDEX_CACHE_H_
#define DPE_VIEWER_RENDER_INDEX_CACHE_H_

#include <memory>
#include <vector>

#include "picture/picture.h"
#include "render/frame_arena.h"
#include "vk/buffer.h"

namespace dpe::viewer {

// Uploads each topology once; forgets it when nobody else holds it any more.
class IndexCache {
 public:
  // The indices, and then the corners.
  using Indices = std::shared_ptr<const vk::Buffer>;
  static VkDeviceSize CornersOffset(const Topology& topology) {
    return topology.triangles.size() * sizeof(std::uint32_t);
  }

  // Bytes that Get will put into the arena: 0 for what is already there.
  VkDeviceSize BytesToUpload(const Topology& topology) const;

  // Records the upload if there is one; outside of a render pass. Hold what is returned
  // until the device has finished the frame. Throws std::invalid_argument if there are
  // fewer vertices than the triangles have.
  Indices Get(const vk::Device& device, VkCommandBuffer commands, FrameArena* arena,
              const Surface& surface);

  // Lets go of topologies that ended.
  void Tidy();

 private:
  struct Entry {
    std::weak_ptr<const Topology> topology;
    std::size_t vertices;  // that the triangles need
    Indices indices;
  };

  const Entry* Find(const Topology& topology) const;

  std::vector<Entry> entries_;
};

}  // namespace dpe::viewer

#endif  // DPE_VIEWER_RENDER_INDEX_CACHE_H_
