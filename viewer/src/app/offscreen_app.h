// Pictures without a window: for documents, reports and tests.
#ifndef DPE_VIEWER_APP_OFFSCREEN_APP_H_
#define DPE_VIEWER_APP_OFFSCREEN_APP_H_

#include <string>
#include <vector>

#include "app/session.h"
#include "vk/device_options.h"

namespace dpe::viewer {

struct OffscreenOptions {
  DeviceOptions device;
  int width = 1280, height = 720;
  int first_frame = 0;
  int frames = 1;
  int every = 1;      // pictures of every so many frames
  std::string png;    // with %04d or the like for the frame's number; empty: none
  std::string video;  // empty: none
  bool legend = true;
  bool panel = false;
};

struct OffscreenResult {
  std::vector<std::string> files;
  int pictures = 0;
  double seconds_drawing = 0.0;
  double seconds_simulating = 0.0;  // waiting for frames
  std::string device;
  std::string failure;  // of the simulation, which then stopped
};

// @throws SceneError for a name without a place for the number, VulkanError and
//         std::runtime_error as the parts do
OffscreenResult RunOffscreen(const OffscreenOptions& options, Session* session);

// "out_%04d.png" and 7: "out_0007.png".
// @throws SceneError for a pattern without exactly one %d or %0Nd
std::string NumberedName(const std::string& pattern, int number);

}  // namespace dpe::viewer

#endif  // DPE_VIEWER_APP_OFFSCREEN_APP_H_
