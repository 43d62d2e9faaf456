#include "app/legend.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

#include "imgui.h"
#include "scene_view/viridis.h"

namespace dpe::viewer {
namespace {

constexpr float kBarWidth = 16.0f, kBarHeight = 180.0f, kMargin = 18.0f;
constexpr float kTickSpace = 76.0f;
constexpr int kSteps = 64;
constexpr ImU32 kText = IM_COL32(235, 235, 235, 255);
constexpr ImU32 kShade = IM_COL32(15, 17, 20, 170);

void DrawText(ImDrawList* list, float x, float y, const std::string& text) {
  list->AddText(ImVec2(x, y), kText, text.c_str());
}

void DrawScale(const ColorScale& scale) {
  ImDrawList* list = ImGui::GetBackgroundDrawList();
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  const std::string title = scale.title + " [" + scale.unit + "]";
  const float title_width = ImGui::CalcTextSize(title.c_str()).x;
  const float line = ImGui::GetTextLineHeight();
  const float x = size.x - kMargin - kBarWidth - kTickSpace;
  const float top = size.y - kMargin - kBarHeight;
  const float left = std::min(x, size.x - kMargin - title_width) - 8.0f;
  list->AddRectFilled(ImVec2(left, top - 2.2f * line), ImVec2(size.x, size.y), kShade);
  DrawText(list, left + 8.0f, top - 1.8f * line, title);
  for (int k = 0; k < kSteps; ++k) {
    const float t0 = static_cast<float>(k) / kSteps, t1 = (k + 1.0f) / kSteps;
    const glm::vec3 c = ViridisSrgb(0.5f * (t0 + t1));
    list->AddRectFilled(ImVec2(x, top + (1.0f - t1) * kBarHeight),
                        ImVec2(x + kBarWidth, top + (1.0f - t0) * kBarHeight),
                        ImGui::GetColorU32(ImVec4(c.x, c.y, c.z, 1.0f)));
  }
  for (const auto& [value, text] : scale.Ticks()) {
    const float y =
        top + (1.0f - static_cast<float>(scale.Position(value))) * kBarHeight;
    list->AddLine(ImVec2(x + kBarWidth, y), ImVec2(x + kBarWidth + 5.0f, y), kText);
    DrawText(list, x + kBarWidth + 9.0f, y - 0.5f * line, text);
  }
}

// A line of text at the right, with its shade from `top` on.
void DrawLine(const std::string& text, float top) {
  const ImVec2 size = ImGui::CalcTextSize(text.c_str());
  const float x = ImGui::GetIO().DisplaySize.x - size.x - kMargin;
  ImDrawList* list = ImGui::GetBackgroundDrawList();
  list->AddRectFilled(ImVec2(x - 8.0f, top),
                      ImVec2(x + size.x + 8.0f, top + 8.0f + size.y), kShade);
  DrawText(list, x, top + 4.0f, text);
}

std::string Caption(const Session& session) {
  const Player& player = session.player();
  char text[128];
  std::snprintf(text, sizeof(text), "frame %d   %.3f s", player.frame(), player.time());
  std::string caption = text;
  const auto frame = static_cast<size_t>(player.frame());
  if (frame < player.errors().size() && std::isfinite(player.errors()[frame])) {
    std::snprintf(text, sizeof(text), "   %.3g m from the target",
                  static_cast<double>(player.errors()[frame]));
    caption += text;
  }
  return caption;
}

}  // namespace

void DrawLegend(const Session& session) {
  if (session.maker().scale()) DrawScale(*session.maker().scale());
  DrawLine(Caption(session), 8.0f);
  if (session.maker().missing().empty()) return;
  const float height = ImGui::GetTextLineHeight() + 8.0f;
  DrawLine(session.maker().missing(), ImGui::GetIO().DisplaySize.y - kMargin - height);
}

}  // namespace dpe::viewer
