#include "dpe/estimation/report_io.h"

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <vector>

#include "json_numbers_io.h"
#include "model_selection_io.h"
#include "uncertainty_io.h"

namespace dpe {
namespace {

using Json = nlohmann::ordered_json;

Json Parameters(const EstimationInput& input, const EstimatorSummary& summary) {
  const TrueParameters truth = TrueParametersOf(input.scenes());
  Json array = Json::array();
  Eigen::Index offset = 0;
  for (size_t b = 0; b < summary.blocks.size(); ++b) {
    const EstimatedBlock& block = summary.blocks[b];
    Json entry;
    // The wind belongs to the scene, not to an object.
    entry["object"] = block.object >= 0 ? Json(block.object) : Json(nullptr);
    entry["capture"] = block.capture >= 0 ? Json(block.capture + 1) : Json(nullptr);
    entry["kind"] = block.kind;
    entry["mode"] = std::string(1, block.mode);
    entry["unit"] = block.unit;
    entry["values"] = JsonNumbers(block.values);
    const bool known = input.truth_is_known && truth.is_known[b];
    const Eigen::Index size = block.values.size();
    entry["true_values"] =
        known ? JsonNumbers(truth.values.segment(offset, size)) : Json(nullptr);
    offset += size;
    if (!block.elements.empty()) entry["elements"] = block.elements;
    entry["inactive"] = block.inactive;
    array.push_back(std::move(entry));
  }
  return array;
}

Json Horizons(const EstimatorSummary& summary) {
  Json array = Json::array();
  for (const HorizonStage& stage : summary.horizons) {
    array.push_back({{"frames", stage.num_frames},
                     {"iterations", stage.iterations},
                     {"start_rms_m", JsonNumber(stage.start_rms)},
                     {"rms_m", JsonNumber(stage.final_rms)}});
  }
  return array;
}

Json TextOrNull(const std::string& text) {
  return text.empty() ? Json(nullptr) : Json(text);
}

Json ValidationToJson(const Validation& validation) {
  return {{"frames", validation.num_frames},
          {"rms_position_error_m", JsonNumber(validation.rms)},
          {"held_out_rms_position_error_m", JsonNumber(validation.held_out_rms)},
          {"note", TextOrNull(validation.note)}};
}

Json Captures(const EstimationInput& input, const EstimatorSummary& summary,
              const std::vector<Validation>& validations) {
  Json array = Json::array();
  for (size_t c = 0; c < input.captures.size(); ++c) {
    array.push_back(
        {{"scene", TextOrNull(input.captures[c].scene_path)},
         {"target", TextOrNull(input.captures[c].target_path)},
         {"frames", summary.captures[c].num_frames},
         {"rms_position_error_m", JsonNumber(summary.captures[c].final_rms)},
         {"sigma_m", JsonNumber(input.captures[c].target.sigma)},
         {"growth", JsonNumber(summary.captures[c].sensitivity.ok
                                   ? summary.captures[c].sensitivity.growth
                                   : std::numeric_limits<double>::quiet_NaN())},
         {"validation", ValidationToJson(validations[c])}});
  }
  return array;
}

Json Priors(const EstimationJob& job) {
  Json array = Json::array();
  for (const Prior& prior : job.options.priors) array.push_back(PriorText(prior));
  return array;
}

Json Smoothness(const EstimatorSummary& summary) {
  Json candidates = Json::array();
  for (const SmoothnessCandidate& candidate : summary.smoothness_candidates) {
    candidates.push_back(
        {{"weight", JsonNumber(candidate.weight)},
         {"training_cost", JsonNumber(candidate.training_cost)},
         {"held_out_cost", JsonNumber(candidate.held_out_cost)},
         {"held_out_rms_m", JsonNumber(candidate.held_out_rms)},
         {"iterations", candidate.iterations},
         {"chosen", candidate.is_chosen},
         {"message",
          candidate.message.empty() ? Json(nullptr) : Json(candidate.message)}});
  }
  Json array = Json::array();
  for (const SmoothnessPrior& one : summary.smoothness) {
    array.push_back(SmoothnessText(one));
  }
  return {{"priors", array}, {"candidates", candidates}};
}

Json SensitivityToJson(const MotionSensitivity& sensitivity) {
  if (!sensitivity.ok) return {{"ok", false}, {"message", sensitivity.message}};
  return {{"ok", true},
          {"growth", JsonNumber(sensitivity.growth)},
          {"doubling_time_s", JsonNumber(sensitivity.doubling_time)},
          {"growth_by_frame", JsonNumbers(sensitivity.growth_by_frame)},
          {"text", sensitivity.text}};
}

}  // namespace

std::string ReportToJson(const EstimationJob& job, const EstimationInput& input,
                         const EstimatorSummary& summary,
                         const std::vector<Validation>& validations,
                         const ModelSelection* selection) {
  const CaptureInput& first = input.captures[0];
  const bool is_one = input.captures.size() == 1;
  Json report;
  // Without a scene file the scene was made of the target.
  report["scene"] = is_one ? TextOrNull(first.scene_path) : Json(nullptr);
  report["settings"] = SettingsString(first.scene);
  report["target"] = is_one ? TextOrNull(first.target_path) : Json(nullptr);
  report["quality"] = job.quality ? Json(PresetOf(*job.quality).name) : Json(nullptr);
  report["integrator"] = IntegrationMethodName(first.scene.integration_method);
  report["steps_per_frame"] = first.scene.steps_per_frame;
  report["frames"] = summary.num_frames;
  report["solver"] = summary.solver;
  report["solver_reason"] = summary.solver_reason;
  report["jacobian"] = summary.jacobian;
  report["init"] = summary.init;
  report["success"] = summary.usable();
  report["termination"] = TerminationName(summary.termination);
  report["message"] = summary.message;
  report["notes"] = summary.notes;
  report["iterations"] = summary.iterations;
  report["evaluations"] = summary.evaluations;
  report["jacobian_evaluations"] = summary.jacobian_evaluations;
  report["wall_time_s"] = JsonNumber(summary.wall_time_s);
  report["initial_cost"] = JsonNumber(summary.initial_cost);
  report["final_cost"] = JsonNumber(summary.final_cost);
  report["prior_cost"] = JsonNumber(summary.prior_cost);
  report["initial_rms_position_error_m"] = JsonNumber(summary.initial_rms);
  report["rms_position_error_m"] = JsonNumber(summary.final_rms);
  report["validation"] = ValidationToJson(Together(validations));
  report["parameter_deviation_percent"] =
      input.truth_is_known && std::isfinite(summary.final_cost)
          ? JsonNumber(ParameterDeviationPercent(summary, input.scenes()))
          : Json(nullptr);
  report["noise_sigma_m"] = JsonNumber(job.noise_sigma);
  report["seed"] = job.options.seed;
  report["sigma_m"] = is_one ? JsonNumber(first.target.sigma) : Json(nullptr);
  report["loss"] = LossTypeName(job.options.loss);
  report["captures"] = Captures(input, summary, validations);
  report["priors"] = Priors(job);
  report["smoothness"] = Smoothness(summary);
  report["horizons"] = Horizons(summary);
  report["parameters"] = Parameters(input, summary);
  report["sensitivity"] = SensitivityToJson(summary.sensitivity);
  report["uncertainty"] = UncertaintyToJson(summary.uncertainty);
  if (selection != nullptr)
    report["model_selection"] = ModelSelectionToJson(*selection);
  // Text that is not UTF-8 (a file name, say) must not make the report fail.
  return report.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace dpe
