#include "experiments/fits/fit_row.h"

#include <cmath>
#include <string>

namespace dpe::experiments {
namespace {

void AddErrors(const EstimatorSummary& summary, const EstimationInput& input,
               const std::vector<Validation>& validations, Record* row) {
  row->Set("rms_m", summary.final_rms);
  const Validation all = Together(validations);
  if (all.num_frames > 0) {
    row->Set("validation_rms_m", all.rms);
    row->Set("held_out_rms_m", all.held_out_rms);
  }
  if (!input.truth_is_known) return;
  const double deviation = ParameterDeviationPercent(summary, input.scenes());
  if (std::isfinite(deviation)) row->Set("deviation_percent", deviation);
}

void AddValues(const EstimatorSummary& summary, Record* row) {
  for (const EstimatedBlock& block : summary.blocks) {
    if (block.values.size() != 1) continue;
    const std::string object =
        block.object >= 0 ? std::to_string(block.object) + "_" : "";
    row->Set("value_" + object + block.kind, block.values[0]);
  }
}

void AddErrorBars(const Uncertainty& uncertainty, Record* row) {
  if (!uncertainty.ok) return;
  row->Set("determined", DeterminedText(uncertainty));
  row->Set("weak_directions", uncertainty.num_weak_directions);
  row->Set("noise_std", uncertainty.noise);
}

}  // namespace

Record FitRow(const EstimatorSummary& summary, const EstimationInput& input,
              const std::vector<Validation>& validations,
              const ModelSelection* selection) {
  Record row;
  row.Set("parameters", static_cast<int>(summary.parameters.size()));
  AddErrors(summary, input, validations, &row);
  AddValues(summary, &row);
  if (!input.auto_objects.empty()) row.Set("chosen_settings", selection->chosen);
  row.Set("termination", TerminationName(summary.termination));
  row.Set("start", summary.init);
  row.Set("solver_used", summary.solver);
  row.Set("jacobian_used", summary.jacobian);
  row.Set("iterations", summary.iterations);
  row.Set("evaluations", summary.evaluations);
  row.Set("derivative_passes", summary.jacobian_evaluations);
  row.Set("horizons", static_cast<int>(summary.horizons.size()));
  AddErrorBars(summary.uncertainty, &row);
  row.Set("fit_s", summary.wall_time_s);
  return row;
}

}  // namespace dpe::experiments
