#include "app/offscreen_app.h"

#include <algorithm>
#include <cctype>
#include <chrono>
#include <memory>
#include <thread>

#include "app/legend.h"
#include "app/panel.h"
#include "app/video.h"
#include "png/png.h"
#include "render/offscreen_renderer.h"

namespace dpe::viewer {
namespace {

using Clock = std::chrono::steady_clock;

double Seconds(Clock::duration time) {
  return std::chrono::duration<double>(time).count();
}

// Shows a frame, simulating up to it. False if the simulation stopped before.
bool GoTo(int frame, Session* session) {
  Player& player = session->player();
  if (!player.is_live()) {
    player.Seek(frame);
    return frame <= player.last_frame();
  }
  while (player.frame() < frame) {
    player.StepForward();
    while (player.IsWaiting()) {
      if (!player.Update(0.0))
        std::this_thread::sleep_for(std::chrono::microseconds(50));
    }
    if (!player.failure().empty()) return false;
  }
  return true;
}

// "%d" or "%04d" at `begin`: its length, else 0.
size_t PlaceLength(const std::string& text, size_t begin, int* digits) {
  size_t end = begin + 1;
  *digits = 0;
  while (end < text.size() && std::isdigit(static_cast<unsigned char>(text[end]))) {
    *digits = 10 * *digits + (text[end++] - '0');
  }
  return end < text.size() && text[end] == 'd' && *digits < 20 ? end + 1 - begin : 0;
}

}  // namespace

std::string NumberedName(const std::string& pattern, int number) {
  std::string name;
  int places = 0;
  for (size_t k = 0; k < pattern.size();) {
    int digits = 0;
    const size_t length = pattern[k] == '%' ? PlaceLength(pattern, k, &digits) : 0;
    if (length == 0) {
      name += pattern[k++];
      continue;
    }
    const std::string text = std::to_string(number);
    name.append(std::max<int>(digits - static_cast<int>(text.size()), 0), '0');
    name += text;
    k += length;
    ++places;
  }
  if (places != 1) {
    throw SceneError("\"" + pattern +
                     "\" is not accepted; expected a name with one place for the "
                     "number of the frame: out_%04d.png");
  }
  return name;
}

OffscreenResult RunOffscreen(const OffscreenOptions& options, Session* session) {
  const bool numbered = options.frames > options.every;
  if (!options.png.empty() &&
      (numbered || options.png.find('%') != std::string::npos)) {
    NumberedName(options.png, 0);
  }
  const Player& player = session->player();
  OffscreenRenderer renderer(options.device, options.width, options.height);
  std::unique_ptr<VideoWriter> video;
  if (!options.video.empty()) {
    video = std::make_unique<VideoWriter>(options.video, options.width, options.height,
                                          1.0 / (player.scene().delta * options.every));
  }
  OffscreenResult result;
  result.device = Describe(renderer.device());
  PanelState panel;
  panel.device = renderer.device().name;
  const auto draw_ui = [&] {
    if (options.legend) DrawLegend(*session);
    if (options.panel) DrawPanel(&panel, session);
  };
  for (int f = 0; f < options.frames; f += options.every) {
    const int frame = options.first_frame + f;
    const Clock::time_point begin = Clock::now();
    if (!GoTo(frame, session)) {
      result.failure = player.failure();
      break;
    }
    const Clock::time_point simulated = Clock::now();
    const Picture picture = session->MakePicture(options.width, options.height,
                                                 options.panel ? kPanelWidth : 0);
    Image image = renderer.Render(picture, draw_ui);
    // ImGui finds the size of a window in its first frame.
    if (options.panel && f == 0) image = renderer.Render(picture, draw_ui);
    result.seconds_simulating += Seconds(simulated - begin);
    result.seconds_drawing += Seconds(Clock::now() - simulated);
    ++result.pictures;
    if (video) video->Add(image);
    if (options.png.empty()) continue;
    const bool has_place = options.png.find('%') != std::string::npos;
    result.files.push_back(has_place ? NumberedName(options.png, frame) : options.png);
    WritePng(result.files.back(), image);
  }
  if (video) {
    video->Finish();
    result.files.push_back(options.video);
  }
  return result;
}

}  // namespace dpe::viewer
