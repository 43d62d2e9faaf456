#include "io/json_node.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "dpe/engine/scene.h"

namespace dpe {
namespace {

constexpr int kMaxInt = std::numeric_limits<int>::max();
constexpr char kAcceptedNumber[] = "a finite number";
constexpr char kAcceptedBool[] = "true or false";
constexpr char kAcceptedVector[] =
    "three finite numbers {\"x\": 0, \"y\": 0, \"z\": 0}";

bool ToNumber(const Json& value, double* number) {
  if (!value.is_number()) return false;
  *number = value.get<double>();
  return std::isfinite(*number);
}

bool ToBool(const Json& value, bool* result) {
  if (!value.is_boolean()) return false;
  *result = value.get<bool>();
  return true;
}

// Whole numbers may be written as 100.0, as some languages do. An integer too large for
// JSON's own integers arrives here as a floating point number.
bool ToInt(const Json& value, int lowest, int* result) {
  if (!value.is_number()) return false;
  const double number = value.get<double>();
  if (!(number >= lowest && number <= kMaxInt) || number != std::floor(number)) {
    return false;
  }
  *result = static_cast<int>(number);
  return true;
}

std::string AcceptedInt(int lowest) {
  return "a whole number from " + std::to_string(lowest) + " to " +
         std::to_string(kMaxInt);
}

}  // namespace

JsonNode JsonNode::Member(const Json& value, const std::string& key) const {
  return {value, path_.empty() ? key : path_ + "." + key, context_};
}

JsonNode JsonNode::Element(size_t index) const {
  return {(*value_)[index], path_ + "[" + std::to_string(index) + "]", context_};
}

std::optional<JsonNode> JsonNode::Find(const std::string& key) const {
  if (!value_->is_object()) Fail("an object {...}");
  const auto found = value_->find(key);
  if (found == value_->end()) return std::nullopt;
  return Member(*found, key);
}

JsonNode JsonNode::Require(const std::string& key, const std::string& accepted) const {
  if (std::optional<JsonNode> member = Find(key)) return *member;
  throw SceneError(context_->file + ": " + (path_.empty() ? "" : path_ + ".") + key +
                   " is missing; expected " + accepted);
}

const Json::array_t& JsonNode::Array(const std::string& accepted) const {
  if (!value_->is_array()) Fail("an array [...] of " + accepted);
  return value_->get_ref<const Json::array_t&>();
}

std::vector<JsonNode> JsonNode::Elements() const {
  std::vector<JsonNode> elements;
  for (size_t i = 0; i < Array("objects").size(); ++i) elements.push_back(Element(i));
  return elements;
}

double JsonNode::AsNumber() const {
  double number = 0.0;
  if (!ToNumber(*value_, &number)) Fail(kAcceptedNumber);
  return number;
}

int JsonNode::AsInt(int lowest) const {
  int number = 0;
  if (!ToInt(*value_, lowest, &number)) Fail(AcceptedInt(lowest));
  return number;
}

bool JsonNode::AsBool() const {
  bool result = false;
  if (!ToBool(*value_, &result)) Fail(kAcceptedBool);
  return result;
}

std::string JsonNode::AsString() const {
  if (!value_->is_string()) Fail("a text in quotation marks");
  return value_->get<std::string>();
}

Eigen::Vector3d JsonNode::AsVector() const {
  if (!value_->is_object()) Fail(kAcceptedVector);
  constexpr const char* kAxes[] = {"x", "y", "z"};
  Eigen::Vector3d vector;
  for (int axis = 0; axis < 3; ++axis) {
    const auto found = value_->find(kAxes[axis]);
    if (found == value_->end()) Require(kAxes[axis], kAcceptedVector);
    if (!ToNumber(*found, &vector[axis])) {
      Member(*found, kAxes[axis]).Fail(kAcceptedNumber);
    }
  }
  if (value_->size() > 3) WarnOfUnknownKeys({"x", "y", "z"});
  return vector;
}

// `convert` returns whether it could. The path of an element is only composed for a
// message: arrays have a million elements.
template <typename Convert>
void JsonNode::MapElements(const std::string& accepted, Convert convert) const {
  const Json::array_t& array = Array(accepted);
  for (size_t i = 0; i < array.size(); ++i) {
    if (!convert(array[i], i)) Element(i).Fail(accepted);
  }
}

Eigen::VectorXd JsonNode::AsNumbers() const {
  Eigen::VectorXd numbers(static_cast<Eigen::Index>(value_->size()));
  MapElements(kAcceptedNumber, [&](const Json& value, size_t i) {
    return ToNumber(value, &numbers[static_cast<Eigen::Index>(i)]);
  });
  return numbers;
}

std::vector<int> JsonNode::AsInts(int lowest) const {
  std::vector<int> numbers(value_->size());
  MapElements(AcceptedInt(lowest), [&](const Json& value, size_t i) {
    return ToInt(value, lowest, &numbers[i]);
  });
  return numbers;
}

std::vector<char> JsonNode::AsBools() const {
  std::vector<char> result(value_->size());
  MapElements(kAcceptedBool, [&](const Json& value, size_t i) {
    bool b = false;
    const bool ok = ToBool(value, &b);
    result[i] = b;
    return ok;
  });
  return result;
}

Eigen::Matrix3Xd JsonNode::AsVectors() const {
  Eigen::Matrix3Xd vectors(3, static_cast<Eigen::Index>(value_->size()));
  const size_t size = Array(kAcceptedVector).size();
  for (size_t i = 0; i < size; ++i) {
    vectors.col(static_cast<Eigen::Index>(i)) = Element(i).AsVector();
  }
  return vectors;
}

std::string JsonNode::ValueText() const {
  const std::string count = std::to_string(value_->size());
  if (value_->is_array()) return "an array of " + count + " elements";
  if (value_->is_object()) return "an object with " + count + " keys";
  std::string text =
      value_->dump(-1, ' ', /*ensure_ascii=*/false, Json::error_handler_t::replace);
  constexpr size_t kMaxLength = 60;
  if (text.size() > kMaxLength) text = text.substr(0, kMaxLength) + "...";
  return text;
}

void JsonNode::WarnOfUnknownKeys(std::initializer_list<const char*> known) const {
  if (context_->warnings == nullptr || !value_->is_object()) return;
  constexpr int kMaxWarnings = 20;  // the same key in each vertex would be thousands
  for (const auto& member : value_->items()) {
    if (std::find(known.begin(), known.end(), member.key()) != known.end()) continue;
    ++context_->num_warnings;
    if (context_->num_warnings > kMaxWarnings) return;
    context_->warnings->push_back(
        context_->file + ": " + Member(member.value(), member.key()).path_ +
        ": unknown key, ignored" +
        (context_->num_warnings == kMaxWarnings ? " (further ones are not listed)"
                                                : ""));
  }
}

void JsonNode::Fail(const std::string& accepted) const {
  throw SceneError(context_->file + ": " + (path_.empty() ? "the file" : path_) + ": " +
                   ValueText() + " is not accepted; expected " + accepted);
}

}  // namespace dpe
