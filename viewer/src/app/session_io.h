// What a session shows, as one line of JSON: for tests and for other programs.
#ifndef DPE_VIEWER_APP_SESSION_IO_H_
#define DPE_VIEWER_APP_SESSION_IO_H_

#include <string>

#include "app/panel.h"
#include "app/session.h"

namespace dpe::viewer {

// What a window knows beyond its session.
struct WindowState {
  int width = 0, height = 0;  // pixels
  long pictures = 0;          // drawn so far
  double pictures_per_second = 0.0;
  bool is_draft = false;  // the last picture
  double cursor_x = 0.0, cursor_y = 0.0;
  bool button_down = false;  // of the mouse
  std::string device;
  WidgetPlaces widgets;
};

// frame, first_frame, last_frame, time_s, paused, live, speed, color, missing (for the
// colours), camera {yaw, pitch, distance, target}, size, cursor, button_down, help,
// error_m (null: not known), tuning {stiffness, mass, damping, drag: of the first
// object; wind}, widgets {at_NAME: [x, y] of its middle in the window}, message,
// failure; and what changes without anything being done: pictures, pictures_per_second,
// draft, frame_ms, rate, device.
std::string StateJson(const Session& session, const WindowState& window);

// The same without what changes by itself, to tell whether anything has been done.
std::string StateKey(const Session& session, const WindowState& window);

}  // namespace dpe::viewer

#endif  // DPE_VIEWER_APP_SESSION_IO_H_
