#include "dpe/estimation/report_io.h"

#include <cmath>
#include <nlohmann/json.hpp>
#include <vector>

#include "dpe/engine/parameters.h"
#include "json_numbers_io.h"
#include "uncertainty_io.h"

namespace dpe {
namespace {

using Json = nlohmann::ordered_json;

Json Parameters(const EstimationInput& input, const EstimatorSummary& summary) {
  const ParameterLayout layout(input.scene);
  const Eigen::VectorXd truth = layout.Extract(input.scene);
  Json array = Json::array();
  for (size_t b = 0; b < summary.blocks.size(); ++b) {
    const EstimatedBlock& block = summary.blocks[b];
    const ParameterBlock& place = layout.blocks()[b];
    Json entry;
    // The wind belongs to the scene, not to an object.
    entry["object"] = block.object >= 0 ? Json(block.object) : Json(nullptr);
    entry["kind"] = block.kind;
    entry["mode"] = std::string(1, block.mode);
    entry["unit"] = block.unit;
    entry["values"] = JsonNumbers(block.values);
    const bool known =
        input.truth_is_known && layout.Represents(input.scene, static_cast<int>(b));
    entry["true_values"] =
        known ? JsonNumbers(truth.segment(place.offset, place.size)) : Json(nullptr);
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
                         const Validation& validation) {
  Json report;
  // Without a scene file the scene was made of the target.
  report["scene"] = job.scene_path.empty() ? Json(nullptr) : Json(job.scene_path);
  report["settings"] = SettingsString(input.scene);
  report["target"] = job.target_path.empty() ? Json(nullptr) : Json(job.target_path);
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
  report["validation"] = {
      {"frames", validation.num_frames},
      {"rms_position_error_m", JsonNumber(validation.rms)},
      {"held_out_rms_position_error_m", JsonNumber(validation.held_out_rms)},
      {"note", validation.note.empty() ? Json(nullptr) : Json(validation.note)}};
  report["parameter_deviation_percent"] =
      input.truth_is_known && std::isfinite(summary.final_cost)
          ? JsonNumber(ParameterDeviationPercent(summary, input.scene))
          : Json(nullptr);
  report["noise_sigma_m"] = JsonNumber(job.noise_sigma);
  report["seed"] = job.options.seed;
  report["sigma_m"] = JsonNumber(input.target.sigma);
  report["loss"] = LossTypeName(job.options.loss);
  report["priors"] = Priors(job);
  report["smoothness"] = Smoothness(summary);
  report["horizons"] = Horizons(summary);
  report["parameters"] = Parameters(input, summary);
  report["sensitivity"] = SensitivityToJson(summary.sensitivity);
  report["uncertainty"] = UncertaintyToJson(summary.uncertainty);
  // Text that is not UTF-8 (a file name, say) must not make the report fail.
  return report.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace dpe
