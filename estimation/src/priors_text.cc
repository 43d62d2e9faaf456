// Priors as text, for command lines, messages and fingerprints.
#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <set>
#include <utility>

#include "dpe/estimation/priors.h"

namespace dpe {
namespace {

constexpr const char* kQuantities =
    "mass, stiffness, damping, drag, wind or initial_velocity";
constexpr const char* kPriorForm =
    "QUANTITY[PART]@OBJECT:DISTRIBUTION:CENTRE,SPREAD, without [PART] and @OBJECT for "
    "all, separated by ';'";
constexpr const char* kSmoothnessForm =
    "QUANTITY@OBJECT=WEIGHT, without @OBJECT for all, separated by ','; WEIGHT is a "
    "number above 0 or auto";

constexpr std::pair<const char*, ParameterKind> kKinds[] = {
    {"mass", ParameterKind::kMass},
    {"stiffness", ParameterKind::kStiffness},
    {"damping", ParameterKind::kDamping},
    {"drag", ParameterKind::kDrag},
    {"wind", ParameterKind::kWind},
    {"initial_velocity", ParameterKind::kInitialVelocity}};

[[noreturn]] void Refuse(const std::string& entry, const std::string& problem,
                         const std::string& accepted) {
  throw SceneError("\"" + entry + "\": " + problem + "; accepted is " + accepted);
}

std::vector<std::string> SplitAt(const std::string& text, char separator) {
  std::vector<std::string> parts(1);
  for (const char c : text) {
    if (c == separator) {
      parts.emplace_back();
    } else {
      parts.back() += c;
    }
  }
  return parts;
}

// A finite number and nothing else.
bool ReadNumber(const std::string& text, double* number) {
  if (text.empty() || std::isspace(static_cast<unsigned char>(text.front()))) {
    return false;
  }
  char* end = nullptr;
  *number = std::strtod(text.c_str(), &end);
  return *end == '\0' && std::isfinite(*number);
}

bool ReadIndex(const std::string& text, int* index) {
  if (text.empty() || text.size() > 9 ||
      !std::all_of(text.begin(), text.end(),
                   [](unsigned char c) { return c >= '0' && c <= '9'; })) {
    return false;
  }
  *index = std::atoi(text.c_str());
  return true;
}

std::string Number(double value) {
  char text[32];
  for (int digits : {6, 15, 17}) {  // the shortest that reads back to the same
    std::snprintf(text, sizeof(text), "%.*g", digits, value);
    if (std::strtod(text, nullptr) == value) break;
  }
  return text;
}

std::string KindText(ParameterKind kind) {
  for (const auto& [name, known] : kKinds) {
    if (known == kind) return name;
  }
  return ParameterKindName(kind);
}

// "stiffness[shear]@0"
void ReadQuantity(const std::string& entry, std::string text, bool has_parts,
                  ParameterKind* kind, std::string* part, int* object) {
  const size_t at = text.find('@');
  if (at != std::string::npos) {
    const std::string number = text.substr(at + 1);
    if (!ReadIndex(number, object)) {
      Refuse(entry, "\"" + number + "\" is no object",
             "the number of an object, from 0, after @");
    }
    text.resize(at);
  }
  const size_t bracket = text.find('[');
  if (has_parts && bracket != std::string::npos) {
    *part = text.substr(bracket + 1);
    if (part->size() < 2 || part->back() != ']') {
      Refuse(entry, "the part in brackets is not closed or empty", "[PART]");
    }
    part->pop_back();
    text.resize(bracket);
  }
  for (const auto& [name, known] : kKinds) {
    if (text != name) continue;
    *kind = known;
    return;
  }
  Refuse(entry, "\"" + text + "\" is no quantity", kQuantities);
}

void CheckPart(const std::string& entry, const Prior& prior) {
  if (prior.part.empty()) return;
  const std::string& part = prior.part;
  int number = 0;
  const std::string problem = "\"" + part + "\" is no part of " + KindText(prior.kind);
  switch (prior.kind) {
    case ParameterKind::kStiffness:
      if (part == "stretch" || part == "shear" || part == "bend") return;
      if (!ReadIndex(part, &number)) {
        Refuse(entry, problem, "stretch, shear, bend or the number of a group");
      }
      return;
    case ParameterKind::kMass:
      if (!ReadIndex(part, &number)) Refuse(entry, problem, "the number of a group");
      return;
    case ParameterKind::kWind:
    case ParameterKind::kInitialVelocity:
      if (part != "x" && part != "y" && part != "z") {
        Refuse(entry, problem, "x, y or z");
      }
      return;
    default:
      Refuse(entry, problem, KindText(prior.kind) + " without brackets");
  }
}

Prior PriorFromEntry(const std::string& entry) {
  const std::vector<std::string> fields = SplitAt(entry, ':');
  if (fields.size() != 3) {
    Refuse(entry, "has " + std::to_string(fields.size()) + " parts between ':'",
           kPriorForm);
  }
  Prior prior;
  ReadQuantity(entry, fields[0], true, &prior.kind, &prior.part, &prior.object);
  CheckPart(entry, prior);
  if (prior.kind == ParameterKind::kWind && prior.object >= 0) {
    Refuse(entry, "the wind belongs to no object", "wind without @");
  }
  if (fields[1] == "normal") {
    prior.distribution = PriorDistribution::kNormal;
  } else if (fields[1] == "lognormal") {
    prior.distribution = PriorDistribution::kLogNormal;
  } else {
    Refuse(entry, "\"" + fields[1] + "\" is no distribution", "normal or lognormal");
  }
  const std::vector<std::string> numbers = SplitAt(fields[2], ',');
  if (numbers.size() != 2 || !ReadNumber(numbers[0], &prior.centre) ||
      !ReadNumber(numbers[1], &prior.spread)) {
    Refuse(entry, "\"" + fields[2] + "\" is not CENTRE,SPREAD",
           "two finite numbers: SI units for normal; the median in SI units and the "
           "standard deviation of the logarithm for lognormal");
  }
  return prior;
}

SmoothnessPrior SmoothnessFromEntry(const std::string& entry) {
  const std::vector<std::string> fields = SplitAt(entry, '=');
  if (fields.size() != 2) {
    Refuse(entry, "has " + std::to_string(fields.size() - 1) + " '='", kSmoothnessForm);
  }
  SmoothnessPrior smoothness;
  std::string no_part;
  ReadQuantity(entry, fields[0], false, &smoothness.kind, &no_part, &smoothness.object);
  if (smoothness.kind != ParameterKind::kStiffness &&
      smoothness.kind != ParameterKind::kMass) {
    Refuse(entry, KindText(smoothness.kind) + " has no neighbours",
           "stiffness or mass");
  }
  std::string weight = fields[1];
  smoothness.is_chosen = weight.rfind("auto", 0) == 0;
  if (weight == "auto") return smoothness;
  if (weight.rfind("auto:", 0) == 0) weight = weight.substr(5);
  if (!ReadNumber(weight, &smoothness.weight) || smoothness.weight <= 0.0) {
    Refuse(entry, "\"" + weight + "\" is no weight",
           "a number above 0, 1 over the variance of the logarithm of the ratio of "
           "neighbours, or auto");
  }
  return smoothness;
}

std::string AtObject(int object) {
  return object >= 0 ? "@" + std::to_string(object) : "";
}

}  // namespace

std::vector<Prior> PriorsFromText(const std::string& text) {
  std::vector<Prior> priors;
  if (text.empty()) return priors;
  for (const std::string& entry : SplitAt(text, ';')) {
    priors.push_back(PriorFromEntry(entry));
  }
  return priors;
}

std::vector<SmoothnessPrior> SmoothnessFromText(const std::string& text) {
  std::vector<SmoothnessPrior> smoothness;
  if (text.empty()) return smoothness;
  std::set<std::pair<ParameterKind, int>> known;
  for (const std::string& entry : SplitAt(text, ',')) {
    smoothness.push_back(SmoothnessFromEntry(entry));
    const auto [kind, object] =
        std::pair(smoothness.back().kind, smoothness.back().object);
    bool is_known = known.count({kind, -1}) > 0;
    for (const auto& [other, of] : known) is_known |= other == kind && object < 0;
    if (is_known || !known.emplace(kind, object).second) {
      Refuse(entry, "is given twice", "each quantity of an object once");
    }
  }
  return smoothness;
}

std::string PriorText(const Prior& prior) {
  return KindText(prior.kind) + (prior.part.empty() ? "" : "[" + prior.part + "]") +
         AtObject(prior.object) +
         (prior.distribution == PriorDistribution::kNormal ? ":normal:"
                                                           : ":lognormal:") +
         Number(prior.centre) + "," + Number(prior.spread);
}

std::string SmoothnessText(const SmoothnessPrior& smoothness) {
  std::string weight = Number(smoothness.weight);
  if (smoothness.is_chosen) {
    weight = smoothness.weight > 0.0 ? "auto:" + weight : "auto";
  }
  return KindText(smoothness.kind) + AtObject(smoothness.object) + "=" + weight;
}

std::string SmoothnessText(const std::vector<SmoothnessPrior>& smoothness) {
  std::string text;
  for (const SmoothnessPrior& one : smoothness) {
    text += (text.empty() ? "" : ",") + SmoothnessText(one);
  }
  return text;
}

}  // namespace dpe
