#include "app/panel.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "imgui.h"

namespace dpe::viewer {
namespace {

constexpr float kWidth = static_cast<float>(kPanelWidth) - 16.0f;
constexpr size_t kMaxPlotPoints = 500;

// Notes where the widget is that was drawn last.
void Note(const std::string& name, PanelState* state) {
  const ImVec2 low = ImGui::GetItemRectMin(), high = ImGui::GetItemRectMax();
  state->widgets[name] = {static_cast<int>(0.5f * (low.x + high.x)),
                          static_cast<int>(0.5f * (low.y + high.y))};
}

void DrawPlayback(PanelState* state, Session* session) {
  Player& player = session->player();
  if (ImGui::Button(player.paused() ? "Play" : "Pause", ImVec2(60, 0))) {
    session->Do(Action::kTogglePause);
  }
  Note("play", state);
  ImGui::SameLine();
  if (ImGui::Button("|<")) session->Do(Action::kRestart);
  ImGui::SameLine();
  if (ImGui::Button("<")) session->Do(Action::kStepBack);
  ImGui::SameLine();
  if (ImGui::Button(">")) session->Do(Action::kStepForward);
  Note("step", state);
  ImGui::SameLine();
  ImGui::Text("%.3f s", player.time());
  int frame = player.frame();
  ImGui::SetNextItemWidth(-50.0f);
  if (ImGui::SliderInt("frame", &frame, player.first_frame(),
                       std::max(player.last_frame(), player.first_frame() + 1))) {
    player.Seek(frame);
  }
  Note("frame", state);
  auto speed = static_cast<float>(player.speed());
  ImGui::SetNextItemWidth(-50.0f);
  if (ImGui::SliderFloat("speed", &speed, 0.05f, 4.0f, "%.2f",
                         ImGuiSliderFlags_Logarithmic)) {
    player.SetSpeed(std::max(speed, 0.01f));
  }
}

void DrawRates(const PanelState& state, const Player& player) {
  if (state.pictures_per_second > 0.0) {
    ImGui::Text("%.0f pictures per second", state.pictures_per_second);
  }
  if (!player.is_live()) {
    ImGui::Text("recorded");
    return;
  }
  ImGui::Text("simulates %.1f ms in %.2f ms", 1e3 * player.scene().delta,
              player.frame_ms());
  if (!player.failure().empty()) {
    ImGui::TextColored(ImVec4(1.0f, 0.4f, 0.3f, 1.0f), "stopped:");
    ImGui::TextWrapped("%s", player.failure().c_str());
  } else if (!player.paused() && player.rate() > 0.0 &&
             player.rate() < 0.95 * player.speed()) {
    ImGui::TextColored(ImVec4(1.0f, 0.8f, 0.3f, 1.0f),
                       "too heavy: runs at %.2f of the speed",
                       player.rate() / player.speed());
  }
}

void DrawColors(PanelState* state, Session* session) {
  ImGui::Text("colour by");
  ImGui::PushID("colour by");  // there is a slider "speed" too
  for (int m = 0; m < kNumColorModes; ++m) {
    const auto mode = static_cast<ColorMode>(m);
    if (mode == ColorMode::kDeviation && !session->maker().has_deviations()) continue;
    if (m % 3 != 0) ImGui::SameLine(92.0f * static_cast<float>(m % 3) + 8.0f);
    if (ImGui::RadioButton(ColorModeName(mode).c_str(),
                           session->view().color == mode)) {
      session->SetColor(mode);
    }
    Note("color_" + ColorModeName(mode), state);
  }
  ImGui::PopID();
  if (!session->maker().missing().empty()) {
    ImGui::TextWrapped("%s", session->maker().missing().c_str());
  }
}

void DrawShown(ViewOptions* view) {
  struct Item {
    const char* name;
    bool* shown;
  };
  const Item items[] = {
      {"surface", &view->surface},     {"edges", &view->wireframe},
      {"springs", &view->springs},     {"fixed", &view->fixed_vertices},
      {"colliders", &view->colliders}, {"ground", &view->ground},
      {"axes", &view->axes},           {"wind", &view->wind}};
  ImGui::Text("show");
  int k = 0;
  for (const Item& item : items) {
    if (k % 3 != 0) ImGui::SameLine(92.0f * static_cast<float>(k % 3) + 8.0f);
    ImGui::Checkbox(item.name, item.shown);
    ++k;
  }
}

bool Slider(const char* name, double low, double high, const char* format,
            double* value) {
  ImGui::SetNextItemWidth(-80.0f);
  return ImGui::SliderScalar(name, ImGuiDataType_Double, value, &low, &high, format,
                             ImGuiSliderFlags_Logarithmic);
}

void DrawParameters(PanelState* state, Session* session) {
  Player& player = session->player();
  Tuning tuning = player.tuning();
  bool turned = false;
  for (size_t o = 0; o < tuning.objects.size(); ++o) {
    ImGui::PushID(static_cast<int>(o));
    if (tuning.objects.size() > 1) ImGui::Text("object %d", static_cast<int>(o));
    ObjectTuning& values = tuning.objects[o];
    turned |= Slider("stiffness", 0.01, 100.0, "x %.3g", &values.stiffness_factor);
    if (o == 0) Note("stiffness", state);
    turned |= Slider("mass", 0.01, 100.0, "x %.3g", &values.mass_factor);
    turned |= Slider("damping", 0.0, 10.0, "%.3g", &values.damping);
    turned |= Slider("drag", 0.0, 10.0, "%.3g", &values.drag_coefficient);
    ImGui::PopID();
  }
  float wind[3];
  for (int k = 0; k < 3; ++k) wind[k] = static_cast<float>(tuning.wind[k]);
  ImGui::SetNextItemWidth(-80.0f);
  if (ImGui::DragFloat3("wind m/s", wind, 0.1f, -200.0f, 200.0f, "%.1f")) {
    for (int k = 0; k < 3; ++k) tuning.wind[k] = wind[k];
    turned = true;
  }
  if (ImGui::Button("As in the file")) {
    tuning = TuningOf(player.scene());
    turned = true;
  }
  Note("as_in_the_file", state);
  if (turned) player.SetTuning(tuning);
  ImGui::SetNextItemWidth(-90.0f);
  ImGui::InputText("##path", state->save_path, sizeof(state->save_path));
  ImGui::SameLine();
  if (ImGui::Button("Save scene")) session->SaveScene(state->save_path);
  Note("save_scene", state);
}

// The error so far, thinned out; what is not known repeats what was before.
void DrawErrors(const Player& player) {
  const std::vector<float>& errors = player.errors();
  if (errors.size() < 2) return;
  const size_t stride = errors.size() / kMaxPlotPoints + 1;
  std::vector<float> points;
  float last = 0.0f, high = 0.0f;
  for (size_t f = 0; f < errors.size(); ++f) {
    if (std::isfinite(errors[f])) last = errors[f];
    high = std::max(high, last);
    if (f % stride == 0) points.push_back(last);
  }
  ImGui::Text("distance to target [m], 0 to %.3g", static_cast<double>(high));
  ImGui::PlotLines("##error", points.data(), static_cast<int>(points.size()), 0,
                   nullptr, 0.0f, high, ImVec2(-1.0f, 70.0f));
}

}  // namespace

void DrawPanel(PanelState* state, Session* session) {
  const Player& player = session->player();
  state->widgets.clear();
  ImGui::SetNextWindowPos(ImVec2(8, 8), ImGuiCond_FirstUseEver);
  ImGui::SetNextWindowSize(ImVec2(kWidth, 0.0f), ImGuiCond_Always);
  ImGui::Begin("dpe_viewer", nullptr, ImGuiWindowFlags_AlwaysAutoResize);
  if (!player.scene().title.empty()) {
    ImGui::TextWrapped("%s", player.scene().title.c_str());
  }
  DrawPlayback(state, session);
  DrawRates(*state, player);
  ImGui::Separator();
  DrawColors(state, session);
  DrawShown(&session->view());
  if (player.tunes_scene() &&
      ImGui::CollapsingHeader("parameters", ImGuiTreeNodeFlags_DefaultOpen)) {
    DrawParameters(state, session);
  }
  DrawErrors(player);
  if (!session->message().empty()) ImGui::TextWrapped("%s", session->message().c_str());
  ImGui::TextDisabled("%s", state->device.c_str());
  ImGui::TextDisabled("H: keys");
  ImGui::End();
}

void DrawHelp(const Session& session) {
  if (!session.shows_help()) return;
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos(ImVec2(0.5f * size.x, 0.5f * size.y), ImGuiCond_Always,
                          ImVec2(0.5f, 0.5f));
  ImGui::Begin("keys", nullptr,
               ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoCollapse);
  ImGui::TextUnformatted(
      "left drag           orbit\n"
      "right drag, Shift   pan\n"
      "W, S, wheel         zoom\n"
      "R                   reset the camera\n"
      "F                   frame the cloth\n"
      "Space               pause, go on\n"
      "Left, Right         a frame back, on\n"
      "Home                restart\n"
      "1 to 6              colour: plain, stiffness, mass,\n"
      "                    stretch, speed, distance\n"
      "7                   standard deviation (--report)\n"
      "P                   save a PNG\n"
      "H                   these keys\n"
      "Esc                 quit");
  ImGui::End();
}

}  // namespace dpe::viewer
