// The panel: everything that the keys do, the time line, parameters and the error.
#ifndef DPE_VIEWER_APP_PANEL_H_
#define DPE_VIEWER_APP_PANEL_H_

#include <array>
#include <map>
#include <string>

#include "app/session.h"

namespace dpe::viewer {

// Pixels that the panel covers on the left.
constexpr int kPanelWidth = 306;

// Where widgets are: the middle of each, in pixels of the window.
using WidgetPlaces = std::map<std::string, std::array<int, 2>>;

struct PanelState {
  double pictures_per_second = 0.0;  // 0: not said
  std::string device;
  char save_path[512] = "tuned_scene.txt";
  WidgetPlaces widgets;  // out: those of the panel as it was drawn last
};

// Within ImGui's frame.
void DrawPanel(PanelState* state, Session* session);

// The keys, in a window of their own, if the session shows them.
void DrawHelp(const Session& session);

}  // namespace dpe::viewer

#endif  // DPE_VIEWER_APP_PANEL_H_
