// Simulates a scene and writes where its vertices go.
#include <gflags/gflags.h>

#include <iostream>
#include <string>
#include <vector>

#include "dpe/engine/scene_io.h"
#include "dpe/engine/simulator.h"
#include "dpe/estimation/trajectory_io.h"
#include "support/blas_threads.h"
#include "support/flag_ranges.h"
#include "support/flag_values.h"
#include "support/run_main.h"

DEFINE_string(scene, "", "Scene file to simulate (required).");
DEFINE_string(output, "",
              "CSV file to write (required): frame,vertex,x,y,z with a header line, as "
              "estimate_cloth --target reads it.");
DEFINE_int32(frames, 0,
             "Number of frames, the initial state included; 0: what the scene says.");
DEFINE_string(integrator, "",
              "Integration method instead of the scene's: explicit_euler, "
              "symplectic_euler, linearly_implicit_euler, implicit_euler, or 0 to 3.");
DEFINE_double(delta, 0.0,
              "Length of a frame in s instead of the scene's; 0: the scene's.");
DEFINE_int32(steps_per_frame, 0,
             "Integration steps per frame instead of the scene's; 0: the scene's.");
DEFINE_int32(threads, 1, "Number of threads.");

namespace dpe::tools {
namespace {

Scene SceneFromFlags() {
  RequireFlag("scene", FLAGS_scene, "the scene file to simulate");
  RequireFlag("output", FLAGS_output, "the CSV file to write");
  RequireAtLeast("frames", FLAGS_frames, 0);
  RequireAtLeast("delta", FLAGS_delta, 0.0);
  RequireAtLeast("steps_per_frame", FLAGS_steps_per_frame, 0);
  RequireAtLeast("threads", FLAGS_threads, 1);
  std::vector<std::string> warnings;
  Scene scene = LoadScene(FLAGS_scene, &warnings);
  for (const std::string& warning : warnings) {
    std::cerr << "simulate_cloth: warning: " << warning << "\n";
  }
  if (!FLAGS_integrator.empty()) {
    scene.integration_method = IntegrationMethodFromName(FLAGS_integrator);
  }
  if (FLAGS_delta > 0.0) scene.delta = FLAGS_delta;
  if (FLAGS_steps_per_frame > 0) scene.steps_per_frame = FLAGS_steps_per_frame;
  return scene;
}

int Main() {
  const Scene scene = SceneFromFlags();
  SetBlasThreads(FLAGS_threads);
  SimulatorOptions options;
  options.num_threads = FLAGS_threads;
  Simulator simulator(scene, options);
  const int frames = FLAGS_frames > 0 ? FLAGS_frames : scene.num_frames;
  const Trajectory trajectory = simulator.Simulate(frames);
  // Frames before a failure are worth having: they show how it came about.
  WriteFileAtomically(FLAGS_output, TrajectoryToCsv(trajectory, scene));
  if (!trajectory.status.ok()) {
    std::cerr << "simulate_cloth: error: " << trajectory.status.Message() << "\n"
              << "The frames before that were written to " << FLAGS_output << "\n";
    return 3;
  }
  std::cout << "Wrote " << frames << " frames to " << FLAGS_output << "\n";
  return 0;
}

}  // namespace
}  // namespace dpe::tools

int main(int argc, char** argv) {
  const dpe::tools::Program program = {
      "simulate_cloth",
      "Simulates a scene and writes the positions of its vertices, frame by frame. "
      "Exit "
      "codes: 0 done, 1 bad flags or input, 3 the simulation failed (the frames before "
      "the failure are written).",
      "--scene FILE --output FILE [--frames N] [--integrator METHOD] [--delta S]",
      __FILE__};
  return dpe::tools::RunMain(argc, argv, program, dpe::tools::Main);
}
