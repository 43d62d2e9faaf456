// Draws what is in a Picture.
#ifndef DPE_VIEWER_RENDER_PICTURE_DRAWER_H_
#define DPE_VIEWER_RENDER_PICTURE_DRAWER_H_

#include <vector>

#include "picture/picture.h"
#include "render/frame_arena.h"
#include "render/index_cache.h"
#include "render/pipelines.h"

namespace dpe::viewer {

// A picture is first uploaded, outside of the scene's pass, then drawn, inside of it.
class PictureDrawer {
 public:
  // What one frame that may be on its way has in the device's memory.
  struct Upload {
    struct Part {
      IndexCache::Indices indices;  // of surfaces
      VkDeviceSize offsets[3] = {0, 0, 0};
    };

    FrameArena arena;
    std::vector<Part> surfaces;
    std::vector<Part> lines;
    std::vector<Part> points;
  };

  PictureDrawer(const vk::Device& device, const RenderPasses& passes);

  // Replaces `upload`, which the device must have finished with. Throws
  // std::invalid_argument if the picture's arrays do not fit together, since the device
  // would read whatever is behind them.
  void Prepare(VkCommandBuffer commands, const Picture& picture, Upload* upload);

  // @param picture  the one that was prepared
  void Draw(VkCommandBuffer commands, const Picture& picture, const Upload& upload,
            VkExtent2D extent) const;

 private:
  const vk::Device& device_;
  Pipelines pipelines_;
  IndexCache indices_;
};

}  // namespace dpe::viewer

#endif  // DPE_VIEWER_RENDER_PICTURE_DRAWER_H_
