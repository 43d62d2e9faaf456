#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "dpe/estimation/estimator.h"
#include "dpe/estimation/observations.h"
#include "experiments/tradeoff/candidate.h"
#include "experiments/tradeoff/jobs.h"
#include "experiments/tradeoff/measures.h"
#include "experiments/tradeoff/reference.h"

namespace dpe::experiments::tradeoff {
namespace {

template <typename Value>
Value OneOf(const std::string& key, const std::string& name,
            const std::vector<std::pair<std::string, Value>>& accepted) {
  std::string names;
  for (const auto& [known, value] : accepted) {
    if (name == known) return value;
    names += (names.empty() ? "" : ", ") + known;
  }
  throw SceneError(key + ": \"" + name + "\" is not accepted; expected " + names);
}

EstimatorOptions OptionsFromJob(const Job& job) {
  EstimatorOptions options;
  options.solver = OneOf<SolverType>("fit_solver", job.Text("fit_solver", "auto"),
                                     {{"auto", SolverType::kAuto},
                                      {"lm", SolverType::kLevenbergMarquardt},
                                      {"lbfgs", SolverType::kLbfgs}});
  options.horizon = OneOf<Horizon>("horizon", job.Text("horizon", "auto"),
                                   {{"auto", Horizon::kAuto},
                                    {"full", Horizon::kFull},
                                    {"grow", Horizon::kGrow},
                                    {"shooting", Horizon::kShooting}});
  options.init = OneOf<InitMethod>(
      "init", job.Text("init", "auto"),
      {{"auto", InitMethod::kAuto}, {"uniform", InitMethod::kUniform}});
  // Within a factor of two of the truth for each of the groups' magnitudes is not
  // needed: N/m, the mean of the legacy cloths.
  options.uniform_value = 20.0;
  options.max_iterations = job.Integer("max_iterations", options.max_iterations);
  options.uncertainty = UncertaintyMode::kOff;
  const int limit = job.Integer("memory_limit_mib", -1);
  if (limit >= 0) options.memory_limit_bytes = static_cast<std::size_t>(limit) << 20;
  return options;
}

Scene SceneToFit(const Job& job, const Candidate& candidate) {
  Scene scene = CandidateScene(candidate, job.Flag("uniform", false));
  ApplySettings(job.Text("settings", "nR"), &scene);
  const std::string estimate = job.Text("estimate", "");
  if (estimate == "damping") {
    scene.objects[0].estimate_damping = true;
  } else if (estimate == "drag") {
    scene.objects[0].estimate_drag = true;
  } else if (!estimate.empty()) {
    throw SceneError("estimate: \"" + estimate +
                     "\" is not accepted; expected damping or drag");
  }
  return scene;
}

double WorstPercent(const EstimatorSummary& summary, const Scene& truth) {
  const TrueParameters known = TrueParametersOf({&truth});
  if (known.values.size() != summary.parameters.size()) {
    return std::numeric_limits<double>::quiet_NaN();
  }
  return 100.0 * ((summary.parameters - known.values).array() / known.values.array())
                     .abs()
                     .maxCoeff();
}

}  // namespace

Record RunFitJob(const Job& job) {
  const Candidate candidate = CandidateFromRecord(job);
  const Scene scene = SceneToFit(job, candidate);
  const Scene plain = CandidateScene(candidate, job.Flag("uniform", false));
  Trajectory truth;
  truth.positions = {CachedReference(plain, candidate.frames).positions};
  const double start = CpuSeconds();
  const EstimatorSummary summary =
      Estimate(scene, ObserveAll(truth), OptionsFromJob(job));
  const double seconds = CpuSeconds() - start;
  Record row;
  // A fit that was to stop early is usable as it is.
  const bool stopped_as_asked =
      summary.termination == Termination::kMaxIterations && job.Has("max_iterations");
  row.Set("stopped", summary.usable() || stopped_as_asked ? "" : summary.message);
  row.Set("termination", TerminationName(summary.termination));
  row.Set("parameters", static_cast<int>(summary.parameters.size()));
  row.Set("bias_percent", ParameterDeviationPercent(summary, scene));
  row.Set("worst_percent", WorstPercent(summary, scene));
  row.Set("residual_rms_m", summary.final_rms);
  row.Set("iterations", summary.iterations);
  row.Set("rollouts", summary.evaluations);
  row.Set("passes", summary.jacobian_evaluations);
  row.Set("total_steps", static_cast<double>(summary.evaluations) *
                             (candidate.frames - 1) * scene.steps_per_frame);
  row.Set("solver_used", summary.solver);
  row.Set("init_used", summary.init);
  row.Set("fit_s", seconds);
  return row;
}

}  // namespace dpe::experiments::tradeoff
