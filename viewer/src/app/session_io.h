// What a session shows, as one line of JSON: for tests and for other programs.
#ifndef DPE_VIEWER_APP_SESSION_IO_H_
#define DPE_VIEWER_APP_SESSION_IO_H_

#include <string>

#include "app/session.h"

namespace dpe::viewer {

// What a window knows beyond its session.
struct WindowState {
  int width = 0, height = 0;  // pixels
  long pictures = 0;          // drawn so far
  double pictures_per_second = 0.0;
  double cursor_x = 0.0, cursor_y = 0.0;
  std::string device;
};

// frame, first_frame, last_frame, time_s, paused, live, color, camera {yaw, pitch,
// distance, target}, size, cursor, help, error_m (null: not known), message, failure;
// and what changes without anything being done: pictures, pictures_per_second,
// frame_ms, rate, device.
std::string StateJson(const Session& session, const WindowState& window);

// The same without what changes by itself, to tell whether anything has been done.
std::string StateKey(const Session& session, const WindowState& window);

}  // namespace dpe::viewer

#endif  // DPE_VIEWER_APP_SESSION_IO_H_
