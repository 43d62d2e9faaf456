#include "uncertainty_io.h"

#include "json_numbers_io.h"

namespace dpe {
namespace {

using Json = nlohmann::ordered_json;

Json Matrix(const Eigen::MatrixXd& matrix) {
  if (matrix.size() == 0) return nullptr;
  Json rows = Json::array();
  for (int i = 0; i < matrix.rows(); ++i) {
    rows.push_back(JsonNumbers(Eigen::VectorXd(matrix.row(i).transpose())));
  }
  return rows;
}

Json Block(const BlockUncertainty& block) {
  Json entry;
  entry["object"] = block.object >= 0 ? Json(block.object) : Json(nullptr);
  if (block.segment >= 0) entry["motion"] = block.segment;
  entry["kind"] = block.kind;
  entry["mode"] = std::string(1, block.mode);
  entry["unit"] = block.unit;
  entry["values"] = JsonNumbers(block.values);
  entry["standard_deviations"] = JsonNumbers(block.standard_deviations);
  entry["relative"] = JsonNumbers(block.relative);
  entry["determined_part"] = JsonNumbers(block.determined_part);
  Json flags = Json::array();
  for (size_t k = 0; k < block.flags.size(); ++k) {
    if (block.flags[k] == 0) continue;
    flags.push_back({{"index", k}, {"names", ParameterFlagNames(block.flags[k])}});
  }
  entry["flags"] = std::move(flags);
  return entry;
}

Json Direction(const Uncertainty& uncertainty, const UndeterminedDirection& direction) {
  Json parts = Json::array();
  for (size_t k = 0; k < direction.parameters.size(); ++k) {
    parts.push_back({{"name", uncertainty.names[direction.parameters[k]]},
                     {"coefficient", direction.coefficients[k]}});
  }
  Json entry;
  entry["exact"] = direction.is_exact;
  entry["pattern"] = DirectionPatternName(direction.pattern);
  entry["num_parameters"] = direction.num_parameters;
  entry["parts"] = std::move(parts);
  entry["data_std"] = JsonNumber(direction.data_std);
  entry["std"] = JsonNumber(direction.std);
  entry["text"] = direction.text;
  return entry;
}

}  // namespace

nlohmann::ordered_json UncertaintyToJson(const Uncertainty& uncertainty) {
  Json json;
  json["ok"] = uncertainty.ok;
  json["message"] =
      uncertainty.message.empty() ? Json(nullptr) : Json(uncertainty.message);
  json["noise_known"] = uncertainty.noise_is_known;
  json["noise"] = JsonNumber(uncertainty.noise);
  json["degrees_of_freedom"] = uncertainty.degrees_of_freedom;
  json["reduced_chi_square"] = JsonNumber(uncertainty.reduced_chi_square);
  json["residual_correlation"] = JsonNumber(uncertainty.residual_correlation);
  json["rank"] = uncertainty.rank;
  json["weak_directions"] = uncertainty.num_weak_directions;
  json["parameters"] = Json::array();
  for (const BlockUncertainty& block : uncertainty.blocks) {
    json["parameters"].push_back(Block(block));
  }
  json["covariance"] = Matrix(uncertainty.covariance);
  json["correlation"] = Matrix(uncertainty.correlation);
  json["strongest_correlations"] = Json::array();
  for (const CorrelatedPair& pair : uncertainty.strongest_pairs) {
    json["strongest_correlations"].push_back(
        {{"first", uncertainty.names[pair.first]},
         {"second", uncertainty.names[pair.second]},
         {"correlation", JsonNumber(pair.correlation)},
         {"text", pair.text}});
  }
  json["directions"] = Json::array();
  for (const UndeterminedDirection& direction : uncertainty.directions) {
    json["directions"].push_back(Direction(uncertainty, direction));
  }
  json["determined"] =
      uncertainty.ok ? Json(DeterminedText(uncertainty)) : Json(nullptr);
  json["statements"] = uncertainty.statements;
  return json;
}

}  // namespace dpe
