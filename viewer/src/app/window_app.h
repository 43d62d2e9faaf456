// A session in a window.
#ifndef DPE_VIEWER_APP_WINDOW_APP_H_
#define DPE_VIEWER_APP_WINDOW_APP_H_

#include <string>

#include "app/session.h"
#include "vk/device_options.h"

namespace dpe::viewer {

struct WindowOptions {
  DeviceOptions device;
  int width = 1280, height = 800;
  std::string title;
  std::string state_file;  // a line of JSON per change, see StateJson; empty: none
  std::string png = "dpe_viewer_%04d.png";  // what P writes, the first free number
  std::string save_path;  // where the panel proposes to save the scene
};

// Until the person quits. The picture is drawn when something has changed: while
// something moves at the display's rate, else not at all.
// @throws VulkanError; std::runtime_error where there is no display
void RunWindow(const WindowOptions& options, Session* session);

// Wakes RunWindow up from any thread, when there is a new frame.
void WakeWindow();

}  // namespace dpe::viewer

#endif  // DPE_VIEWER_APP_WINDOW_APP_H_
