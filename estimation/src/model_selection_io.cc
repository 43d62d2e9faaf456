#include "model_selection_io.h"

#include "json_numbers_io.h"

namespace dpe {
namespace {

using Json = nlohmann::ordered_json;

Json ToJson(const ModelCandidate& candidate) {
  Json row;
  row["settings"] = candidate.settings;
  row["parameters"] = candidate.num_parameters;
  row["termination"] = candidate.was_fitted
                           ? Json(TerminationName(candidate.termination))
                           : Json(nullptr);
  row["iterations"] = candidate.iterations;
  row["seconds"] = JsonNumber(candidate.seconds);
  row["fit_rms_m"] = JsonNumber(candidate.fit_rms);
  row["held_out_rms_m"] = JsonNumber(candidate.held_out_rms);
  row["compared_with"] =
      candidate.compared_with.empty() ? Json(nullptr) : Json(candidate.compared_with);
  row["weight"] = JsonNumber(candidate.weight);
  row["weight_deviation"] = JsonNumber(candidate.weight_deviation);
  row["kept"] = candidate.kept;
  row["reason"] = candidate.reason;
  return row;
}

}  // namespace

Json ModelSelectionToJson(const ModelSelection& selection) {
  Json json;
  json["criterion"] = selection.criterion;
  json["frames"] = selection.num_frames;
  json["fitted_frames"] = selection.num_fitted_frames;
  json["held_out_frames"] = selection.num_frames - selection.num_fitted_frames;
  json["candidates"] = Json::array();
  for (const ModelCandidate& candidate : selection.candidates) {
    json["candidates"].push_back(ToJson(candidate));
  }
  json["chosen"] = selection.chosen;
  json["reason"] = selection.reason;
  return json;
}

}  // namespace dpe
