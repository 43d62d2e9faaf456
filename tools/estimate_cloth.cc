// Recovers the physical parameters of a cloth from how it moves.
#include <gflags/gflags.h>
#include <unistd.h>

#include <chrono>
#include <iostream>
#include <string>
#include <vector>

#include "dpe/engine/quality.h"
#include "dpe/estimation/estimation_job.h"
#include "support/blas_threads.h"
#include "support/estimator_names.h"
#include "support/flag_ranges.h"
#include "support/flag_values.h"
#include "support/interrupt.h"
#include "support/model_table.h"
#include "support/progress_table.h"
#include "support/repeated_flag.h"
#include "support/run_main.h"
#include "support/target/target_flags.h"

DEFINE_string(
    scene, "",
    "Scene file. Without it the scene is made of the target, which then has to "
    "be meshes (OBJ files): one cloth under gravity. Of several captures of one "
    "cloth each may have its own: as many as targets, in their order, given as "
    "--target is.");
DEFINE_validator(scene, &dpe::tools::RememberValue);
DEFINE_double(density, 0.1, "Mass per area (kg/m^2) of a cloth made of the target.");
DEFINE_string(pin_vertices, "still",
              "Vertices (0,3,7) that are fixed in a cloth made of the target; still: "
              "those that never move in it; none.");
DEFINE_string(integrator, "tr_bdf2",
              "Integration method of a scene made of the target, by name or number.");
DEFINE_int32(steps_per_frame, 4,
             "Integration steps in a frame of a scene made of the target.");
DEFINE_string(
    quality, "",
    "Time stepping instead of the scene's: draft, standard, accurate or reference. "
    "docs/quality.md says what they cost and how far parameters are off that are "
    "fitted to a real motion with them. Without --target the motion that is to be "
    "recovered is made with it, too. --integrator and --steps_per_frame, of a scene "
    "made of the target, win where they are given. Without it the scene's own is used, "
    "which is what reproduces a motion that was made with the scene as it is.");
DEFINE_string(
    target, "",
    "What was observed: CSV (frame,vertex,x,y,z or time,marker,x,y,z, with "
    "sigma if known), TRC, a folder or pattern of OBJ files, PC2, or NumPy "
    ".npy (frames x vertices x 3). Missing rows are missing observations. "
    "Without it the scene's own parameters make the target, and then serve "
    "for nothing but the report of the deviation. Several captures of one cloth "
    "are fitted together: give the flag once for each, or the paths separated "
    "by commas. Mass, stiffness, damping and drag are one for all; wind and "
    "initial velocity are each capture's own. The other --target_ flags are "
    "for all of them.");
DEFINE_validator(target, &dpe::tools::RememberValue);
DEFINE_string(rest_shape, "",
              "Where rest lengths come from instead of the scene: an OBJ file, or "
              "uv[:SIZE] or uv[:U,V] for the target's texture coordinates, scaled to "
              "metres.");
DEFINE_string(estimate, "",
              "More to estimate than --settings: damping, drag, wind, "
              "initial_velocity, separated by commas.");
DEFINE_bool(
    estimate_initial_velocity, false,
    "The same as --estimate initial_velocity: how fast every vertex moves at the "
    "start.");
DEFINE_string(
    uncertainty, "auto",
    "Error bars: on, off, or auto: if the noise is known or there are at most "
    "100 parameters.");
DEFINE_string(trajectory_format, "csv",
              "Format of the fitted motion that is written: csv, obj, pc2 or npy.");
DEFINE_string(
    settings, "",
    "What to estimate instead of what the scene says: two letters per object, "
    "mass then stiffness, objects separated by commas. n: not estimated, G: "
    "one value, L: one per vertex or spring, R: one per group. auto, for all or in "
    "place of an object's letters: the simplest stiffness (G, R, L) that forecasts "
    "frames that are held out as well as any; the mass as the scene says.");
DEFINE_int32(frames, 0,
             "Frames to fit, the initial state included; 0: what the scene says. Of "
             "several captures the shorter ones are fitted whole.");
DEFINE_int32(
    validate_frames, 0,
    "Frames over which the fitted scene is compared with the target; 0: none.");
DEFINE_string(solver, "auto",
              "auto, lm (Levenberg-Marquardt) or lbfgs. auto takes lm unless its "
              "Jacobian would need more than 1 GB.");
DEFINE_string(
    jacobian, "auto",
    "auto (the cheaper one), adjoint or tangent. Both give the same numbers.");
DEFINE_string(init, "auto",
              "Where to start. inverse_dynamics: linear least squares on the equations "
              "of motion; scene: the scene's values; uniform:VALUE: one value for all "
              "(SI units); screen: log-spaced trial values. auto: inverse_dynamics if "
              "every free vertex is observed, else screen for up to 8 parameters, else "
              "scene.");
DEFINE_double(init_perturbation, 0.0,
              "Multiply every starting value by exp(this times a normal number).");
DEFINE_string(
    horizon, "auto",
    "full: fit all frames at once; grow: fit the first few, then more and "
    "more, each from the one before; auto: grow for lm, "
    "unless inverse dynamics gave the start; else full. shooting: fit windows of "
    "10 frames with states of their own, which are made to join.");
DEFINE_double(sigma, 0.0,
              "Standard deviation (m) of the noise on each observed coordinate, for "
              "observations that name none of their own; 0: --noise_sigma.");
DEFINE_string(
    loss, "none",
    "What an observation far from the model counts: none (its square), huber, "
    "cauchy or tukey.");
DEFINE_double(
    loss_scale, 0.0,
    "Scale of --loss in standard deviations of the noise; 0: the one at which "
    "95 % of the efficiency is kept on normal noise.");
DEFINE_string(
    prior, "",
    "What is known of parameters beforehand, separated by ';': "
    "QUANTITY:normal:MEAN,STD (SI units) or QUANTITY:lognormal:MEDIAN,STD (of the "
    "logarithm). QUANTITY is mass, stiffness, damping, drag, wind or "
    "initial_velocity, where wanted with a part and an object: stiffness[shear]@0.");
DEFINE_string(
    smoothness, "",
    "How alike neighbouring springs or vertices of mode L are, as stiffness=WEIGHT or "
    "mass=WEIGHT, separated by commas: 1 over the variance of the logarithm of their "
    "ratio (100: they differ by 10 %). auto: the weight with which a fit to the first "
    "80 % of the frames predicts the others best.");
DEFINE_int32(max_iterations, -1,
             "Most iterations of the solver; -1: 200 for lm, 5000 for lbfgs, on each "
             "horizon.");
DEFINE_double(max_seconds, 1e9, "Stop with the best so far after this many seconds.");
DEFINE_double(noise_sigma, 0.0,
              "Standard deviation (m) of normal noise to add to the target.");
DEFINE_uint64(seed, 0, "Seed of --noise_sigma and --init_perturbation.");
DEFINE_string(output_dir, "",
              "Folder for the results; default results/<scene>_<settings>.");
DEFINE_string(
    checkpoint, "",
    "File in which to keep how far the fit has got; written after every accepted "
    "iteration, the old one or the new one whole at any moment.");
DEFINE_string(
    resume, "",
    "Checkpoint from which to continue, with the same scene, target and options. "
    "May be the file of --checkpoint.");
DEFINE_int32(threads, 1, "Number of threads.");
DEFINE_int32(
    memory_limit, 2048,
    "What a rollout may keep in memory for its derivatives beyond the "
    "trajectory, MiB; derivatives make the rest again, to the same result. Not "
    "counted are the Jacobian of lm and the observations.");
DEFINE_bool(print_times, false,
            "Print where the time of the fit went (also if the scene's printTimes is "
            "true).");

namespace dpe::tools {
namespace {

// What makes a scene of the target is an error where there is one.
SceneFromTargetOptions SceneFromTargetFromFlags() {
  if (!FLAGS_scene.empty()) {
    for (const char* flag :
         {"density", "pin_vertices", "integrator", "steps_per_frame"}) {
      if (FlagIsGiven(flag)) {
        throw SceneError("--" + std::string(flag) +
                         " is about a scene made of the target; --scene replaces it");
      }
    }
  } else {
    RequireFlag("target", FLAGS_target,
                "what was observed, unless --scene is a scene file whose own motion is "
                "to be the target");
  }
  RequireAtLeast("steps_per_frame", FLAGS_steps_per_frame, 1);
  SceneFromTargetOptions options;
  options.material.density = FLAGS_density;
  if (FLAGS_pin_vertices == "none") {
    options.without_pins = true;
  } else if (FLAGS_pin_vertices != "still") {
    options.pins = ParseIndices("pin_vertices", FLAGS_pin_vertices);
  }
  options.integration_method =
      FromFlag("integrator", FLAGS_integrator, IntegrationMethodFromName);
  options.steps_per_frame = FLAGS_steps_per_frame;
  return options;
}

EstimationJob JobFromFlags() {
  RequireAtLeast("frames", FLAGS_frames, 0);
  RequireAtLeast("validate_frames", FLAGS_validate_frames, 0);
  RequireAtLeast("init_perturbation", FLAGS_init_perturbation, 0.0);
  RequireAtLeast("max_iterations", FLAGS_max_iterations, -1);
  RequireAtLeast("max_seconds", FLAGS_max_seconds, 0.0);
  RequireAtLeast("noise_sigma", FLAGS_noise_sigma, 0.0);
  RequireAtLeast("sigma", FLAGS_sigma, 0.0);
  RequireAtLeast("loss_scale", FLAGS_loss_scale, 0.0);
  RequireAtLeast("threads", FLAGS_threads, 1);
  RequireAtLeast("memory_limit", FLAGS_memory_limit, 0);
  EstimationJob job;
  job.scene_paths = RepeatedPaths("scene");
  job.scene_from_target = SceneFromTargetFromFlags();
  if (FlagIsGiven("quality")) {
    job.quality = FromFlag("quality", FLAGS_quality, QualityFromName);
    job.keep_integrator = FlagIsGiven("integrator");
    job.keep_steps_per_frame = FlagIsGiven("steps_per_frame");
  }
  job.settings = FLAGS_settings;
  job.target_paths = RepeatedPaths("target");
  job.target = TargetFromFlags();
  job.target.rest_shape = FLAGS_rest_shape;
  job.estimate = Split(FLAGS_estimate, ',');
  if (FLAGS_estimate_initial_velocity) job.estimate.push_back("initial_velocity");
  job.trajectory_format =
      FromFlag("trajectory_format", FLAGS_trajectory_format, TrajectoryFormatFromName);
  job.options.uncertainty =
      FromFlag("uncertainty", FLAGS_uncertainty, UncertaintyFromName);
  job.num_frames = FLAGS_frames;
  job.num_validation_frames = FLAGS_validate_frames;
  job.noise_sigma = FLAGS_noise_sigma;
  job.noise_seed = FLAGS_seed;
  job.output_dir = FLAGS_output_dir;
  job.options.solver = FromFlag("solver", FLAGS_solver, SolverFromName);
  job.options.jacobian = FromFlag("jacobian", FLAGS_jacobian, JacobianFromName);
  const Start start = FromFlag("init", FLAGS_init, StartFromName);
  job.options.init = start.method;
  job.options.uniform_value = start.uniform_value;
  job.sigma = FLAGS_sigma;
  job.options.horizon = FromFlag("horizon", FLAGS_horizon, HorizonFromName);
  job.options.loss = FromFlag("loss", FLAGS_loss, LossTypeFromName);
  job.options.loss_scale = FLAGS_loss_scale;
  job.options.priors = FromFlag("prior", FLAGS_prior, PriorsFromText);
  job.options.smoothness = FromFlag("smoothness", FLAGS_smoothness, SmoothnessFromText);
  job.options.init_perturbation = FLAGS_init_perturbation;
  job.options.seed = FLAGS_seed;
  job.options.max_iterations = FLAGS_max_iterations;
  job.options.max_seconds = FLAGS_max_seconds;
  job.options.checkpoint_path = FLAGS_checkpoint;
  job.options.resume_path = FLAGS_resume;
  job.options.num_threads = FLAGS_threads;
  job.options.memory_limit_bytes = static_cast<std::size_t>(FLAGS_memory_limit) << 20;
  return job;
}

int ExitCode(Termination termination) {
  switch (termination) {
    case Termination::kConverged:
      return 0;
    case Termination::kMaxIterations:
    case Termination::kMaxSeconds:
    case Termination::kInterrupted:
      return 2;
    case Termination::kStartFailed:
    case Termination::kNumericalFailure:
      break;
  }
  return 3;
}

int Main() {
  EstimationJob job = JobFromFlags();
  UseOneBlasThread();
  EstimationInput input = LoadEstimationInput(job);
  for (const std::string& warning : input.warnings) {
    std::cerr << "estimate_cloth: warning: " << warning << "\n";
  }
  const std::string output_dir = PrepareOutputDir(job, input);
  CatchInterrupts();
  if (job.quality) {
    std::cout << QualityText(FLAGS_quality, input.captures[0].scene) << "\n";
  }
  PrintTask(input);
  ProgressTable table(isatty(STDOUT_FILENO) != 0);
  table.PrintHeader();
  job.options.progress = [&](const IterationReport& r) { table.PrintIteration(r); };
  const auto start = std::chrono::steady_clock::now();
  job.options.interrupted = [&] {
    const std::chrono::duration<double> elapsed =
        std::chrono::steady_clock::now() - start;
    table.Tick(elapsed.count());
    return WasInterrupted();
  };
  Timings timings;
  const bool print_times = FLAGS_print_times || input.captures[0].scene.print_times;
  if (print_times) job.options.timings = &timings;
  ModelSelection selection;
  const EstimatorSummary summary =
      RunEstimation(job.options, PrintModelFit, &input, &selection);
  const bool is_auto = !input.auto_objects.empty();
  if (is_auto) PrintModelSelection(selection);
  const std::vector<Validation> validations = Validate(summary, input, FLAGS_threads);
  PrintSummary(input, summary, validations,
               WriteResults(job, input, summary, validations, output_dir,
                            is_auto ? &selection : nullptr));
  if (print_times) {
    std::cout << timings.Table(summary.wall_time_s, "start, optimiser");
  }
  return ExitCode(summary.termination);
}

}  // namespace
}  // namespace dpe::tools

int main(int argc, char** argv) {
  const dpe::tools::Program program = {
      "estimate_cloth",
      "Recovers masses and stiffnesses of a cloth, and what else the scene marks as "
      "estimated, from how it moves. Exit codes: 0 the result is usable, 1 bad flags "
      "or "
      "input, 2 stopped before converging (the best so far is written; also after "
      "Ctrl-C), 3 numerical failure.",
      "--scene FILE [--target FILE]... [--settings nL] [--frames N] [--validate_frames "
      "M] "
      "[--init METHOD] [--output_dir DIR]",
      __FILE__};
  return dpe::tools::RunMain(argc, argv, program, dpe::tools::Main);
}
