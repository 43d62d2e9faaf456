// Shows a cloth as it moves: live, recorded, beside another one or beside what was
// seen.
#include <gflags/gflags.h>

#include <cstdio>
#include <filesystem>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include "app/offscreen_app.h"
#include "app/session.h"
#include "app/window_app.h"
#include "dpe/engine/scene_io.h"
#include "scene_view/deviations_io.h"
#include "support/blas_threads.h"
#include "support/flag_ranges.h"
#include "support/flag_values.h"
#include "support/run_main.h"
#include "support/target/target_flags.h"
#include "vk/device_options.h"
#include "vk/validation_log.h"

DEFINE_string(compare, "", "A second scene, simulated beside the first: a wireframe.");
DEFINE_string(
    target, "",
    "What was observed, in any format that estimate_cloth --target reads; the "
    "scene is then a green wireframe over it.");
DEFINE_string(
    trajectory, "",
    "A recorded motion of the scene to play in place of a simulation, as "
    "simulate_cloth and estimate_cloth write it, or in any format of --target.");
DEFINE_double(trajectory_scale, 0.0,
              "Metres per unit of the trajectory; 0: what the file says, else 1.");
DEFINE_string(trajectory_up, "y", "The trajectory's axis that points up: y or z.");
DEFINE_double(trajectory_rate, 0.0,
              "Frames per second of a trajectory without times; 0: the scene's.");
DEFINE_string(
    report, "",
    "report.json of estimate_cloth, for the colouring by standard deviation.");
DEFINE_string(
    color, "plain",
    "Colour by plain, stiffness, mass, stretch, speed, distance (to the target "
    "or the compared scene) or deviation.");
DEFINE_string(show, "",
              "What to show instead of the usual: surface, edges, springs, fixed, "
              "colliders, ground, axes, wind, separated by commas.");
DEFINE_double(speed, 1.0, "Seconds played per second.");
DEFINE_bool(paused, false, "Begin paused.");
DEFINE_double(yaw, 34.0, "Where the camera stands about the vertical, degrees.");
DEFINE_double(pitch, 20.0, "How far above the camera stands, degrees.");
DEFINE_double(zoom, 1.0, "How much larger than just whole the cloth is seen.");
DEFINE_string(size, "1280x800", "Width and height in pixels.");
DEFINE_bool(offscreen, false, "Draw pictures into files; needs no display.");
DEFINE_int32(frames, 1, "Off screen: how many frames.");
DEFINE_int32(first_frame, 0, "Off screen: the first frame that is drawn.");
DEFINE_int32(every, 1, "Off screen: draw one of so many frames.");
DEFINE_string(
    png, "",
    "Off screen: PNG files to write, out_%04d.png with the frame's number. In "
    "a window: what the key P writes.");
DEFINE_string(video, "", "Off screen: video to write (out.mp4), through ffmpeg.");
DEFINE_bool(legend, true, "Off screen: draw caption and legend.");
DEFINE_bool(panel, false, "Off screen: draw the panel.");
DEFINE_string(device, "",
              "Graphics device: its number in --list_devices, or a part of "
              "its name; empty: the best.");
DEFINE_int32(
    samples, 4,
    "Samples per pixel, 1, 2, 4 or 8, as far as the device can: fewer are drawn "
    "faster, with steps at the cloth's edge.");
DEFINE_bool(list_devices, false, "List the graphics devices and end.");
DEFINE_bool(validation, false,
            "Have the validation layer check all drawing; its messages are errors.");
DEFINE_string(state_file, "",
              "File for a line of JSON whenever what is shown changes, for tests.");

namespace dpe::viewer {
namespace {

using tools::FromFlag;

std::string scene_path;

int ListAllDevices() {
  const std::vector<DeviceDescription> devices = ListDevices();
  if (devices.empty()) std::cout << "There is no Vulkan device.\n";
  for (const DeviceDescription& device : devices) {
    std::cout << Describe(device) << "\n";
  }
  return 0;
}

void PrintWarnings(const std::vector<std::string>& warnings) {
  for (const std::string& warning : warnings) {
    std::cerr << "dpe_viewer: warning: " << warning << "\n";
  }
}

TargetOptions TrajectoryFromFlags() {
  TargetOptions trajectory;
  trajectory.capture.scale = FLAGS_trajectory_scale;
  trajectory.capture.up =
      FromFlag("trajectory_up", FLAGS_trajectory_up, UpAxisFromName);
  trajectory.capture.rate = FLAGS_trajectory_rate;
  return trajectory;
}

PlayerSources SourcesFromFlags() {
  PlayerSources sources;
  std::vector<std::string> warnings;
  sources.scene = LoadScene(scene_path, &warnings);
  if (!FLAGS_target.empty()) {
    sources.target = LoadRecordedMotion(FLAGS_target, tools::TargetFromFlags(),
                                        &sources.scene, &warnings);
  }
  if (!FLAGS_trajectory.empty()) {
    Scene scene = sources.scene;
    sources.trajectory =
        LoadRecordedMotion(FLAGS_trajectory, TrajectoryFromFlags(), &scene, &warnings);
    if (!sources.trajectory->shows_vertices()) {
      throw SceneError("--trajectory: " + FLAGS_trajectory +
                       " shows no vertices, only markers; it can be a --target");
    }
  }
  if (!FLAGS_compare.empty()) {
    sources.compared = LoadScene(FLAGS_compare, &warnings);
    if (sources.compared->delta != sources.scene.delta) {
      throw SceneError(FLAGS_compare +
                       ": delta: " + std::to_string(sources.compared->delta) +
                       " is not accepted; expected that of " + scene_path + ", " +
                       std::to_string(sources.scene.delta));
    }
  }
  PrintWarnings(warnings);
  return sources;
}

ViewOptions ViewFromFlags() {
  ViewOptions view;
  view.color = FromFlag("color", FLAGS_color, ColorModeFromName);
  if (FLAGS_show.empty()) return view;
  const std::pair<const char*, bool*> items[] = {
      {"surface", &view.surface},     {"edges", &view.wireframe},
      {"springs", &view.springs},     {"fixed", &view.fixed_vertices},
      {"colliders", &view.colliders}, {"ground", &view.ground},
      {"axes", &view.axes},           {"wind", &view.wind}};
  for (const auto& item : items) *item.second = false;
  for (const std::string& name : tools::Split(FLAGS_show, ',')) {
    bool found = false;
    for (const auto& item : items) {
      if (name != item.first) continue;
      *item.second = found = true;
    }
    if (!found) {
      throw SceneError("--show: \"" + name +
                       "\" is not accepted; expected surface, edges, springs, fixed, "
                       "colliders, ground, axes or wind");
    }
  }
  return view;
}

void SizeFromFlag(int* width, int* height) {
  char rest = 0;
  if (std::sscanf(FLAGS_size.c_str(), "%dx%d%c", width, height, &rest) != 2 ||
      *width < 1 || *height < 1 || *width > 16384 || *height > 16384) {
    throw SceneError("--size: \"" + FLAGS_size +
                     "\" is not accepted; expected WIDTHxHEIGHT in pixels, each from 1 "
                     "to 16384");
  }
}

std::unique_ptr<Session> SessionFromFlags() {
  PlayerSources sources = SourcesFromFlags();
  sources.on_frame = WakeWindow;
  Deviations deviations;
  if (!FLAGS_report.empty()) deviations = ReadDeviations(FLAGS_report, sources.scene);
  auto session = std::make_unique<Session>(std::move(sources), std::move(deviations),
                                           ViewFromFlags());
  if (session->view().color == ColorMode::kDeviation &&
      !session->maker().has_deviations()) {
    throw SceneError("--color: deviation needs --report");
  }
  constexpr double kDegree = 3.14159265358979 / 180.0;
  session->camera().SetHomeAngles(static_cast<float>(FLAGS_yaw * kDegree),
                                  static_cast<float>(FLAGS_pitch * kDegree));
  session->camera().SetHomeZoom(static_cast<float>(FLAGS_zoom));
  session->player().SetSpeed(FLAGS_speed);
  return session;
}

int PicturesOffscreen(const DeviceOptions& device, Session* session) {
  OffscreenOptions options;
  options.device = device;
  SizeFromFlag(&options.width, &options.height);
  options.first_frame = FLAGS_first_frame;
  options.frames = FLAGS_frames;
  options.every = FLAGS_every;
  options.png = FLAGS_png;
  options.video = FLAGS_video;
  options.legend = FLAGS_legend;
  options.panel = FLAGS_panel;
  const OffscreenResult result = RunOffscreen(options, session);
  for (const std::string& file : result.files) std::cout << "Wrote " << file << "\n";
  if (result.pictures > 0) {
    std::cout << result.pictures << " pictures; each took "
              << 1e3 * result.seconds_simulating / result.pictures
              << " ms to simulate and "
              << 1e3 * result.seconds_drawing / result.pictures << " ms to draw on "
              << result.device << "\n";
  }
  if (result.failure.empty()) return 0;
  std::cerr << "dpe_viewer: error: " << result.failure << "\n";
  return 3;
}

void ShowWindow(const DeviceOptions& device, Session* session) {
  WindowOptions options;
  options.device = device;
  SizeFromFlag(&options.width, &options.height);
  const std::filesystem::path path(scene_path);
  options.title = "dpe_viewer - " + path.filename().string();
  options.state_file = FLAGS_state_file;
  if (!FLAGS_png.empty()) options.png = FLAGS_png;
  options.save_path = path.stem().string() + "_tuned.txt";
  session->player().SetPaused(FLAGS_paused);
  RunWindow(options, session);
}

void CheckRanges() {
  tools::RequireAtLeast("frames", FLAGS_frames, 1);
  tools::RequireAtLeast("first_frame", FLAGS_first_frame, 0);
  tools::RequireAtLeast("every", FLAGS_every, 1);
  tools::RequireAtLeast("speed", FLAGS_speed, 0.001);
  if (FLAGS_samples != 1 && FLAGS_samples != 2 && FLAGS_samples != 4 &&
      FLAGS_samples != 8) {
    throw SceneError("--samples: " + std::to_string(FLAGS_samples) +
                     " is not accepted; expected 1, 2, 4 or 8");
  }
  tools::RequireAtLeast("trajectory_scale", FLAGS_trajectory_scale, 0.0);
  tools::RequireAtLeast("trajectory_rate", FLAGS_trajectory_rate, 0.0);
  tools::RequireAtLeast("zoom", FLAGS_zoom, 0.001);
  if (!FLAGS_offscreen && !FLAGS_video.empty()) {
    throw SceneError("--video: needs --offscreen");
  }
}

int Main() {
  if (FLAGS_list_devices) return ListAllDevices();
  if (scene_path.empty()) {
    throw SceneError("no scene is given; expected the scene file to show (see --help)");
  }
  CheckRanges();
  tools::UseOneBlasThread();
  DeviceOptions device;
  device.device = FLAGS_device;
  device.samples = FLAGS_samples;
  device.validation = FLAGS_validation;
  device.log = std::make_shared<ValidationLog>();
  const std::unique_ptr<Session> session = SessionFromFlags();
  int code = 0;
  if (FLAGS_offscreen) {
    code = PicturesOffscreen(device, session.get());
  } else {
    ShowWindow(device, session.get());
  }
  for (const std::string& message : device.log->messages()) {
    std::cerr << "dpe_viewer: validation: " << message << "\n";
    code = 4;
  }
  return code;
}

}  // namespace
}  // namespace dpe::viewer

int main(int argc, char** argv) {
  const dpe::tools::Program program = {
      "dpe_viewer",
      "Shows a cloth as it moves: simulated live, recorded, compared with another one "
      "or "
      "with what was observed. H shows the keys. Exit codes: 0 done, 1 bad flags, "
      "input "
      "or device, 3 the simulation failed (off screen), 4 the validation layer had "
      "something to say.",
      "SCENE [--compare SCENE2] [--target FILE] [--trajectory FILE] [--offscreen --png "
      "out_%04d.png]",
      __FILE__, &dpe::viewer::scene_path};
  return dpe::tools::RunMain(argc, argv, program, dpe::viewer::Main);
}
