#include "scene_view/deviations_io.h"

#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <sstream>

#include "dpe/engine/parameters.h"

namespace dpe::viewer {
namespace {

using Json = nlohmann::json;

[[noreturn]] void Fail(const std::string& path, const std::string& what) {
  throw SceneError(path + ": " + what);
}

Json ReadJson(const std::string& path) {
  std::ifstream file(path);
  if (!file) Fail(path, "cannot be read");
  std::ostringstream text;
  text << file.rdbuf();
  try {
    return Json::parse(text.str());
  } catch (const Json::exception& error) {
    Fail(path, std::string("is not JSON: ") + error.what());
  }
}

// One value per element of the block, NaN where an element has no influence.
Eigen::VectorXd Spread(const Json& values, const ParameterBlock& block,
                       const std::string& path) {
  if (static_cast<int>(values.size()) != block.size) {
    Fail(path, "has " + std::to_string(values.size()) + " values of " +
                   ParameterKindName(block.kind) + " of object " +
                   std::to_string(block.object) + ", and the scene has " +
                   std::to_string(block.size) + ": it is of another scene");
  }
  Eigen::VectorXd spread = Eigen::VectorXd::Constant(
      static_cast<Eigen::Index>(block.element_to_local.size()),
      std::numeric_limits<double>::quiet_NaN());
  for (size_t e = 0; e < block.element_to_local.size(); ++e) {
    const int local = block.element_to_local[e];
    if (local < 0) continue;
    // What is not finite is null: a deviation without a bound.
    spread[e] = values[local].is_number() ? values[local].get<double>()
                                          : std::numeric_limits<double>::infinity();
  }
  return spread;
}

Deviations FromReport(const Json& report, const std::string& path, Scene scene) {
  const Json& uncertainty = report.at("uncertainty");
  if (!uncertainty.at("ok").get<bool>()) {
    const Json& message = uncertainty.at("message");
    Fail(path,
         "has no standard deviations: " +
             (message.is_string() ? message.get<std::string>() : "not estimated"));
  }
  ApplySettings(report.at("settings").get<std::string>(), &scene);
  Deviations deviations;
  deviations.stiffness.resize(scene.objects.size());
  deviations.mass.resize(scene.objects.size());
  const ParameterLayout layout(scene);
  for (const Json& entry : uncertainty.at("parameters")) {
    if (!entry.at("object").is_number()) continue;
    for (const ParameterBlock& block : layout.blocks()) {
      if (block.object != entry.at("object").get<int>() ||
          ParameterKindName(block.kind) != entry.at("kind").get<std::string>()) {
        continue;
      }
      const Json& values = entry.at("standard_deviations");
      if (block.kind == ParameterKind::kStiffness) {
        deviations.stiffness[block.object] = Spread(values, block, path);
      } else if (block.kind == ParameterKind::kMass) {
        deviations.mass[block.object] = Spread(values, block, path);
      }
    }
  }
  if (!deviations.has_stiffness() && !deviations.has_mass()) {
    Fail(path, "estimated neither stiffness nor mass of this scene's objects");
  }
  return deviations;
}

}  // namespace

Deviations ReadDeviations(const std::string& path, const Scene& scene) {
  const Json report = ReadJson(path);
  try {
    return FromReport(report, path, scene);
  } catch (const Json::exception& error) {
    Fail(path, std::string("is not a report of estimate_cloth: ") + error.what());
  }
}

}  // namespace dpe::viewer
