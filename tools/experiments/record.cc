#include "experiments/record.h"

#include <cmath>
#include <sstream>

#include "dpe/engine/scene.h"

namespace dpe::experiments {
namespace {

std::string AsText(const Record::Value& value) {
  std::ostringstream text;
  text.precision(17);
  text << std::boolalpha;
  std::visit([&](const auto& v) { text << v; }, value);
  return text.str();
}

[[noreturn]] void Refuse(const std::string& key, const Record::Value& value,
                         const std::string& accepted) {
  throw SceneError(key + ": " + AsText(value) + " is not accepted; expected " +
                   accepted);
}

}  // namespace

void Record::Set(const std::string& key, Value value) {
  for (auto& [name, old] : values_) {
    if (name == key) {
      old = std::move(value);
      return;
    }
  }
  values_.emplace_back(key, std::move(value));
}

bool Record::Has(const std::string& key) const { return Find(key) != nullptr; }

const Record::Value* Record::Find(const std::string& key) const {
  for (const auto& [name, value] : values_) {
    if (name == key) return &value;
  }
  return nullptr;
}

double Record::Number(const std::string& key, double missing) const {
  const Value* value = Find(key);
  if (value == nullptr) return missing;
  if (const auto* number = std::get_if<double>(value)) return *number;
  if (const auto* whole = std::get_if<std::int64_t>(value)) {
    return static_cast<double>(*whole);
  }
  Refuse(key, *value, "a number");
}

int Record::Integer(const std::string& key, int missing) const {
  const Value* value = Find(key);
  if (value == nullptr) return missing;
  const auto* whole = std::get_if<std::int64_t>(value);
  if (whole == nullptr || *whole != static_cast<int>(*whole)) {
    Refuse(key, *value, "a whole number");
  }
  return static_cast<int>(*whole);
}

std::string Record::Text(const std::string& key, const std::string& missing) const {
  const Value* value = Find(key);
  if (value == nullptr) return missing;
  const auto* text = std::get_if<std::string>(value);
  if (text == nullptr) Refuse(key, *value, "text");
  return *text;
}

bool Record::Flag(const std::string& key, bool missing) const {
  const Value* value = Find(key);
  if (value == nullptr) return missing;
  const auto* flag = std::get_if<bool>(value);
  if (flag == nullptr) Refuse(key, *value, "true or false");
  return *flag;
}

}  // namespace dpe::experiments
