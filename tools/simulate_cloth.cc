// Simulates a scene and writes where its vertices go.
#include <gflags/gflags.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <iostream>
#include <string>
#include <vector>

#include "dpe/engine/quality.h"
#include "dpe/engine/scene_io.h"
#include "dpe/engine/simulator.h"
#include "dpe/estimation/trajectory_io.h"
#include "support/blas_threads.h"
#include "support/flag_ranges.h"
#include "support/flag_values.h"
#include "support/interrupt.h"
#include "support/run_main.h"

DEFINE_string(scene, "", "Scene file to simulate (required).");
DEFINE_string(output, "",
              "File to write (required), in a format that estimate_cloth --target "
              "reads. For OBJ files, one per frame, a name with a '*' that becomes the "
              "number of the frame: frames/cloth_*.obj.");
DEFINE_string(format, "auto",
              "csv (frame,vertex,x,y,z), obj, pc2 (point cache, 7 digits), npy (NumPy, "
              "frames x vertices x 3), or auto: by the end of --output, else csv.");
DEFINE_int32(frames, 0,
             "Number of frames, the initial state included; 0: what the scene says.");
DEFINE_string(
    integrator, "",
    "Integration method instead of the scene's: explicit_euler, "
    "symplectic_euler, linearly_implicit_euler, implicit_euler, tr_bdf2, or 0 to "
    "4.");
DEFINE_double(delta, 0.0,
              "Length of a frame in s instead of the scene's; 0: the scene's.");
DEFINE_int32(steps_per_frame, 0,
             "Integration steps per frame instead of the scene's; 0: the scene's.");
DEFINE_string(
    quality, "",
    "Time stepping instead of the scene's: draft, standard, accurate or reference. "
    "docs/quality.md says what they cost and give. --integrator and --steps_per_frame "
    "win where they are given. Without it the scene's own is used, which is what the "
    "motion of an existing scene was made with.");
DEFINE_int32(threads, 1, "Number of threads.");
DEFINE_bool(print_times, false,
            "Print where the time went (also if the scene's printTimes is true).");

namespace dpe::tools {
namespace {

// Shows on a terminal, and only there, how far a rollout has come; counts from any
// thread.
class StepProgress {
 public:
  explicit StepProgress(long num_steps)
      : num_steps_(num_steps), is_terminal_(isatty(STDERR_FILENO) != 0) {}

  void Step() {
    const long done = num_done_++;
    if (!is_terminal_ || done % 50 != 0) return;
    std::cerr << "\rsimulating: " << 100 * done / num_steps_ << " % " << std::flush;
  }
  void Clear() const {
    if (is_terminal_) std::cerr << "\r                    \r" << std::flush;
  }

 private:
  long num_steps_;
  bool is_terminal_;
  std::atomic<long> num_done_{0};
};

// @param options  receives what a quality says of them
Scene SceneFromFlags(SimulatorOptions* options) {
  RequireFlag("scene", FLAGS_scene, "the scene file to simulate");
  RequireFlag("output", FLAGS_output, "the file to write");
  RequireAtLeast("frames", FLAGS_frames, 0);
  RequireAtLeast("delta", FLAGS_delta, 0.0);
  RequireAtLeast("steps_per_frame", FLAGS_steps_per_frame, 0);
  RequireAtLeast("threads", FLAGS_threads, 1);
  std::vector<std::string> warnings;
  Scene scene = LoadScene(FLAGS_scene, &warnings);
  for (const std::string& warning : warnings) {
    std::cerr << "simulate_cloth: warning: " << warning << "\n";
  }
  if (FLAGS_delta > 0.0) scene.delta = FLAGS_delta;
  if (FlagIsGiven("quality")) {
    const Quality quality = FromFlag("quality", FLAGS_quality, QualityFromName);
    ApplyStepSettings(SimulationSettings(quality, scene), &scene, options);
  }
  if (!FLAGS_integrator.empty()) {
    scene.integration_method = IntegrationMethodFromName(FLAGS_integrator);
  }
  if (FLAGS_steps_per_frame > 0) scene.steps_per_frame = FLAGS_steps_per_frame;
  return scene;
}

// "7 frames to out.csv" or "7 frames to a_0000.obj ... a_0006.obj"
std::string Written(const std::vector<std::string>& files, int frames) {
  std::string text = std::to_string(frames) + " frames to " + files.front();
  if (files.size() > 1) text += " ... " + files.back();
  return text;
}

int Main() {
  SimulatorOptions options;
  const Scene scene = SceneFromFlags(&options);
  const TrajectoryFormat format =
      FromFlag("format", FLAGS_format, TrajectoryFormatFromName);
  UseOneBlasThread();
  options.num_threads = FLAGS_threads;
  const int frames = FLAGS_frames > 0 ? FLAGS_frames : scene.num_frames;
  CheckTrajectoryOutput(FLAGS_output, format, frames);
  if (FlagIsGiven("quality")) std::cout << QualityText(FLAGS_quality, scene) << "\n";
  CatchInterrupts();
  StepProgress progress(static_cast<long>(frames - 1) * scene.steps_per_frame *
                        scene.objects.size());
  options.interrupted = [&progress] {
    progress.Step();
    return WasInterrupted();
  };
  Timings timings;
  const bool print_times = FLAGS_print_times || scene.print_times;
  if (print_times) options.timings = &timings;
  const auto start = std::chrono::steady_clock::now();
  Simulator simulator(scene, options);
  const Trajectory trajectory = simulator.Simulate(frames);
  const std::chrono::duration<double> elapsed =
      std::chrono::steady_clock::now() - start;
  progress.Clear();
  // Frames before a failure are worth having: they show how it came about.
  const std::vector<std::string> files =
      WriteTrajectory(FLAGS_output, format, trajectory, scene);
  if (!trajectory.status.ok()) {
    std::cerr << "simulate_cloth: error: " << trajectory.status.Message() << "\n"
              << "The frames before that were written to " << FLAGS_output << "\n";
    return trajectory.status.code == RolloutStatus::Code::kInterrupted ? 2 : 3;
  }
  std::cout << "Wrote " << Written(files, frames) << "\n";
  if (print_times) std::cout << timings.Table(elapsed.count(), "set-up");
  return 0;
}

}  // namespace
}  // namespace dpe::tools

int main(int argc, char** argv) {
  const dpe::tools::Program program = {
      "simulate_cloth",
      "Simulates a scene and writes the positions of its vertices, frame by frame. "
      "Exit "
      "codes: 0 done, 1 bad flags or input, 2 stopped by Ctrl-C, 3 the simulation "
      "failed "
      "(the frames before that are written).",
      "--scene FILE --output FILE [--format F] [--frames N] [--quality Q] "
      "[--integrator METHOD] [--delta S]",
      __FILE__};
  return dpe::tools::RunMain(argc, argv, program, dpe::tools::Main);
}
