#include "experiments/record_io.h"

#include <cmath>
#include <cstdint>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <set>
#include <type_traits>
#include <utility>

#include "dpe/engine/scene.h"

namespace dpe::experiments {
namespace {

using Json = nlohmann::ordered_json;

Json ToJson(const Record& record) {
  Json object = Json::object();
  for (const auto& [key, value] : record.values()) {
    std::visit(
        [&object, &name = key](const auto& v) {
          if constexpr (std::is_same_v<std::decay_t<decltype(v)>, double>) {
            object[name] = std::isfinite(v) ? Json(v) : Json(nullptr);
          } else {
            object[name] = v;
          }
        },
        value);
  }
  return object;
}

std::string Dump(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

Record::Value ToValue(const Json& json, const std::string& place) {
  switch (json.type()) {
    case Json::value_t::null:
      return std::numeric_limits<double>::quiet_NaN();
    case Json::value_t::boolean:
      return json.get<bool>();
    case Json::value_t::number_float:
      return json.get<double>();
    case Json::value_t::string:
      return json.get<std::string>();
    case Json::value_t::number_unsigned:
      if (json.get<std::uint64_t>() > std::numeric_limits<std::int64_t>::max()) break;
      return json.get<std::int64_t>();
    case Json::value_t::number_integer:
      return json.get<std::int64_t>();
    default:
      break;
  }
  throw SceneError(place + ": " + Dump(json) +
                   " is not accepted; expected true, false, a number, text or null");
}

Record ToRecord(const Json& json, const std::string& where) {
  if (!json.is_object()) {
    throw SceneError(where + ": " + Dump(json) +
                     " is not accepted; expected an object, {\"id\": \"a\", ...}");
  }
  Record record;
  for (const auto& [key, value] : json.items()) {
    record.Set(key, ToValue(value, where + ", " + key));
  }
  return record;
}

// The parser keeps the last of several equal keys; here they are an error.
Json Parse(const std::string& text, const std::string& where) {
  std::vector<std::set<std::string>> keys;
  const auto check = [&](int, Json::parse_event_t event, Json& parsed) {
    if (event == Json::parse_event_t::object_start) keys.emplace_back();
    if (event == Json::parse_event_t::object_end) keys.pop_back();
    if (event == Json::parse_event_t::key &&
        !keys.back().insert(parsed.get<std::string>()).second) {
      throw SceneError(where + ": the key " + Dump(parsed) + " is there twice");
    }
    return true;
  };
  try {
    return Json::parse(text, check);
  } catch (const nlohmann::json::exception& error) {
    throw SceneError(where + ": not JSON: " + error.what());
  }
}

}  // namespace

std::string RecordToJson(const Record& record) { return Dump(ToJson(record)); }

Record RecordFromJson(const std::string& text, const std::string& where) {
  return ToRecord(Parse(text, where), where);
}

std::vector<Record> ReadRecords(const std::string& path) {
  std::ifstream file(path);
  if (!file) throw SceneError(path + ": cannot be read");
  std::vector<Record> records;
  std::string line;
  for (int number = 1; std::getline(file, line); ++number) {
    if (line.find_first_not_of(" \t\r") == std::string::npos) continue;
    records.push_back(RecordFromJson(line, path + ":" + std::to_string(number)));
  }
  if (file.bad()) throw SceneError(path + ": cannot be read to its end");
  return records;
}

std::string NamedRecordsToJson(const NamedRecords& records) {
  Json object = Json::object();
  for (const auto& [name, record] : records) object[name] = ToJson(record);
  return Dump(object);
}

NamedRecords NamedRecordsFromJson(const std::string& text, const std::string& where) {
  const Json json = Parse(text, where);
  if (!json.is_object()) throw SceneError(where + ": not an object of records");
  NamedRecords records;
  for (const auto& [name, value] : json.items()) {
    records.emplace_back(name, ToRecord(value, where + ", " + name));
  }
  return records;
}

}  // namespace dpe::experiments
