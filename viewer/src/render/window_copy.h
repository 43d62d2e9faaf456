// From the image that was drawn to the one that the window shows.
#ifndef DPE_VIEWER_RENDER_WINDOW_COPY_H_
#define DPE_VIEWER_RENDER_WINDOW_COPY_H_

#include <vulkan/vulkan.h>

#include "render/render_passes.h"

namespace dpe::viewer {

// Formats with the order of colors of a window's, so that bytes can be copied as they
// are.
ColorFormats FormatsLike(VkFormat window_format);

// Copies `drawn`, which is the source of copies, to `shown`, and makes that ready to be
// presented. Both have the same extent.
void RecordCopyToWindow(VkCommandBuffer commands, VkImage drawn, VkImage shown,
                        VkExtent2D extent);

}  // namespace dpe::viewer

#endif  // DPE_VIEWER_RENDER_WINDOW_COPY_H_
