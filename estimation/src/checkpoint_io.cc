#include <cerrno>
#include <cmath>
#include <cstring>
#include <fstream>
#include <iterator>
#include <limits>
#include <nlohmann/json.hpp>

#include "dpe/engine/scene.h"
#include "dpe/engine/scene_io.h"
#include "dpe/estimation/checkpoint.h"

namespace dpe {
namespace {

using Json = nlohmann::ordered_json;

constexpr char kFormat[] = "dpe checkpoint";

// Reads members of a JSON object, with errors that name file and key.
class Members {
 public:
  Members(const Json& json, const std::string& name) : json_(json), name_(name) {}

  template <typename T>
  T Get(const std::string& key, const std::string& expected) const {
    try {
      return json_.at(key).get<T>();
    } catch (const nlohmann::json::exception&) {
      Fail(key, expected);
    }
  }

  int Count(const std::string& key) const {
    if (!json_.contains(key) || !json_[key].is_number_integer()) {
      Fail(key, "a number from 0");
    }
    const int value = Get<int>(key, "a number from 0");
    if (value < 0) Fail(key, "a number from 0");
    return value;
  }

  double NonNegative(const std::string& key) const {
    const double value = Get<double>(key, "a number from 0");
    if (!(value >= 0.0)) Fail(key, "a number from 0");
    return value;
  }

  // A number from 0, or NaN for null.
  double NonNegativeOrNull(const std::string& key) const {
    if (json_.contains(key) && json_[key].is_null()) {
      return std::numeric_limits<double>::quiet_NaN();
    }
    return NonNegative(key);
  }

  Eigen::VectorXd Vector(const std::string& key) const {
    const auto values = Get<std::vector<double>>(key, "a list of numbers");
    return Eigen::Map<const Eigen::VectorXd>(values.data(), values.size());
  }

  [[noreturn]] void Fail(const std::string& key, const std::string& expected) const {
    throw SceneError(name_ + ": " + key + " is " +
                     (json_.contains(key) ? json_[key].dump() : "missing") +
                     "; expected " + expected);
  }

 private:
  const Json& json_;
  const std::string& name_;
};

Json Number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

// Written with as many digits as read back to the same numbers.
std::vector<double> Numbers(const Eigen::VectorXd& values) {
  return std::vector<double>(values.begin(), values.end());
}

Json HorizonToJson(const HorizonStage& stage) {
  return {{"num_frames", stage.num_frames},
          {"iterations", stage.iterations},
          {"start_rms", Number(stage.start_rms)},
          {"final_rms", Number(stage.final_rms)}};
}

HorizonStage HorizonFromJson(const Json& json, const std::string& name) {
  const Members members(json, name);
  HorizonStage stage;
  stage.num_frames = members.Count("num_frames");
  stage.iterations = members.Count("iterations");
  stage.start_rms = members.NonNegativeOrNull("start_rms");
  stage.final_rms = members.NonNegativeOrNull("final_rms");
  return stage;
}

Json ParseObject(const std::string& text, const std::string& name) {
  try {
    Json json = Json::parse(text);
    if (json.is_object() && json.value("format", Json()) == kFormat) return json;
  } catch (const nlohmann::json::exception& error) {
    throw SceneError(name +
                     ": is not a checkpoint, or only part of one: " + error.what());
  }
  throw SceneError(name + ": is not a checkpoint (it has no \"format\": \"" + kFormat +
                   "\")");
}

}  // namespace

std::string CheckpointToJson(const Checkpoint& checkpoint) {
  Json json;
  json["format"] = kFormat;
  json["version"] = Checkpoint::kVersion;
  Json problem = Json::object();
  for (const auto& [name, value] : checkpoint.problem) problem[name] = value;
  json["problem"] = std::move(problem);
  json["stage"] = checkpoint.stage;
  json["init"] = checkpoint.init;
  json["notes"] = checkpoint.notes;
  json["num_frames"] = checkpoint.num_frames;
  Json horizons = Json::array();
  for (const HorizonStage& stage : checkpoint.horizons) {
    horizons.push_back(HorizonToJson(stage));
  }
  json["horizons"] = std::move(horizons);
  json["iterations"] = checkpoint.iterations;
  json["first_iteration"] = checkpoint.first_iteration;
  json["radius"] = checkpoint.radius;
  json["seconds"] = checkpoint.seconds;
  json["initial_cost"] = Number(checkpoint.initial_cost);
  json["initial_rms"] = Number(checkpoint.initial_rms);
  json["cost"] = Number(checkpoint.cost);
  json["start"] = Numbers(checkpoint.start);
  json["coordinates"] = Numbers(checkpoint.coordinates);
  return json.dump(1) + "\n";
}

Checkpoint ParseCheckpoint(const std::string& text, const std::string& name) {
  const Json json = ParseObject(text, name);
  const Members members(json, name);
  const int version = members.Count("version");
  if (version != Checkpoint::kVersion) {
    throw SceneError(name + ": is a checkpoint of version " + std::to_string(version) +
                     "; this program reads version " +
                     std::to_string(Checkpoint::kVersion));
  }
  Checkpoint checkpoint;
  const Json problem = members.Get<Json>("problem", "an object");
  if (!problem.is_object()) members.Fail("problem", "an object");
  for (const auto& [key, value] : problem.items()) {
    if (!value.is_string()) members.Fail("problem", "an object with text values");
    checkpoint.problem.emplace_back(key, value.get<std::string>());
  }
  const std::string stages = "start, grow or fit";
  checkpoint.stage = members.Get<std::string>("stage", stages);
  if (checkpoint.stage != "start" && checkpoint.stage != "grow" &&
      checkpoint.stage != "fit") {
    members.Fail("stage", stages);
  }
  checkpoint.init = members.Get<std::string>("init", "text");
  checkpoint.notes = members.Get<std::vector<std::string>>("notes", "a list of texts");
  checkpoint.num_frames = members.Count("num_frames");
  const std::string a_list = "a list of objects";
  for (const Json& stage : members.Get<std::vector<Json>>("horizons", a_list)) {
    if (!stage.is_object()) members.Fail("horizons", a_list);
    checkpoint.horizons.push_back(HorizonFromJson(stage, name));
  }
  checkpoint.iterations = members.Count("iterations");
  checkpoint.first_iteration = members.Count("first_iteration");
  checkpoint.radius = members.NonNegative("radius");
  checkpoint.seconds = members.NonNegative("seconds");
  checkpoint.initial_cost = members.NonNegativeOrNull("initial_cost");
  checkpoint.initial_rms = members.NonNegativeOrNull("initial_rms");
  checkpoint.cost = members.NonNegativeOrNull("cost");
  checkpoint.start = members.Vector("start");
  checkpoint.coordinates = members.Vector("coordinates");
  if (checkpoint.start.size() != checkpoint.coordinates.size()) {
    members.Fail("start", "as many numbers as coordinates");
  }
  return checkpoint;
}

Checkpoint ReadCheckpoint(const std::string& path) {
  std::ifstream stream(path, std::ios::binary);
  std::string text((std::istreambuf_iterator<char>(stream)),
                   std::istreambuf_iterator<char>());
  if (!stream) {
    throw SceneError(path + ": the checkpoint cannot be read: " + std::strerror(errno));
  }
  return ParseCheckpoint(text, path);
}

void WriteCheckpoint(const Checkpoint& checkpoint, const std::string& path) {
  WriteFileAtomically(path, CheckpointToJson(checkpoint));
}

}  // namespace dpe
