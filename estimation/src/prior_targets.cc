#include "prior_targets.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>
#include <string>

#include "neighbours.h"

namespace dpe {
namespace {

using Rows = std::vector<std::vector<PriorRows::Row>>;

[[noreturn]] void Refuse(const std::string& what, const std::string& text,
                         const std::string& problem, const std::string& accepted) {
  throw SceneError(what + " \"" + text + "\": " + problem + "; accepted is " +
                   accepted);
}

// "stiffness of object 0, wind"
std::string WhatIsEstimated(const ParameterLayout& layout, bool only_local) {
  std::string text;
  std::set<std::string> known;
  for (const ParameterBlock& block : layout.blocks()) {
    const bool has_neighbours =
        block.kind == ParameterKind::kMass || block.kind == ParameterKind::kStiffness;
    if (only_local && (block.mode != ParameterMode::kLocal || !has_neighbours)) {
      continue;
    }
    if (block.kind == ParameterKind::kInitialPosition) continue;
    std::string one = ParameterKindName(block.kind);
    std::replace(one.begin(), one.end(), ' ', '_');
    if (block.object >= 0) one += " of object " + std::to_string(block.object);
    if (known.insert(one).second) text += (text.empty() ? "" : ", ") + one;
  }
  return text.empty() ? "nothing here" : text;
}

void CheckNumbers(const Prior& prior) {
  const bool is_log = prior.distribution == PriorDistribution::kLogNormal;
  const std::string text = PriorText(prior);
  if (!(prior.spread > 0.0) || !std::isfinite(prior.spread)) {
    Refuse("prior", text, "the spread is not above 0",
           is_log ? "the standard deviation of the logarithm"
                  : "the standard deviation in " + ParameterKindUnit(prior.kind));
  }
  if (!std::isfinite(prior.centre)) {
    Refuse("prior", text, "the centre is not a finite number", "one");
  }
  if (!is_log) return;
  if (!ParameterKindIsPositive(prior.kind)) {
    Refuse("prior", text,
           "a lognormal prior needs a quantity that is positive by nature", "normal");
  }
  if (!(prior.centre > 0.0)) {
    Refuse("prior", text, "the centre is not above 0",
           "the median in " + ParameterKindUnit(prior.kind));
  }
}

bool IsInGroup(const std::string& part, const std::vector<int>& groups, int element) {
  return std::to_string(groups[element]) == part;
}

// Whether a prior is about an element of a block of its kind.
bool IsPart(const Scene& scene, const Prior& prior, const ParameterBlock& block,
            int element) {
  if (prior.part.empty()) return true;
  if (prior.kind == ParameterKind::kWind ||
      prior.kind == ParameterKind::kInitialVelocity) {
    return prior.part[0] - 'x' == element % 3;
  }
  const ClothObject& cloth = scene.objects[block.object];
  if (prior.kind == ParameterKind::kMass) {
    return IsInGroup(prior.part, VertexGroups(cloth), element);
  }
  for (const SpringKind kind :
       {SpringKind::kStretch, SpringKind::kShear, SpringKind::kBend}) {
    if (prior.part != SpringKindName(kind)) continue;
    return !cloth.spring_kind.empty() && cloth.spring_kind[element] == kind;
  }
  return IsInGroup(prior.part, SpringGroups(cloth), element);
}

// 1 for the unknowns of a block that a prior is about.
std::vector<char> Chosen(const Scene& scene, const Prior& prior,
                         const ParameterBlock& block) {
  std::vector<char> chosen(block.size, 0), others(block.size, 0);
  for (int e = 0; e < static_cast<int>(block.element_to_local.size()); ++e) {
    const int local = block.element_to_local[e];
    if (local >= 0) (IsPart(scene, prior, block, e) ? chosen : others)[local] = 1;
  }
  for (int k = 0; k < block.size; ++k) {
    if (!chosen[k] || !others[k]) continue;
    Refuse("prior", PriorText(prior),
           "the " + ParameterKindName(prior.kind) + " of object " +
               std::to_string(block.object) + " is one value for \"" + prior.part +
               "\" and others (mode " + ParameterModeLetter(block.mode) + ")",
           "a prior without a part, or mode R or L");
  }
  return chosen;
}

bool IsOf(const ParameterBlock& block, ParameterKind kind, int object) {
  return block.kind == kind && (object < 0 || block.object == object);
}

// sqrt(w g) of priors.h, (2), for pairs of local unknowns.
double DifferenceScale(double weight, int num_unknowns,
                       const std::vector<PriorRows::Row>& pairs, int offset) {
  std::vector<int> parent(num_unknowns);
  std::iota(parent.begin(), parent.end(), 0);
  const auto root = [&](int i) {
    while (parent[i] != i) i = parent[i] = parent[parent[i]];
    return i;
  };
  if (pairs.empty()) return 0.0;
  int num_joined = 0;  // unknowns less connected components
  for (const PriorRows::Row& pair : pairs) {
    const int a = root(pair.a - offset), b = root(pair.b - offset);
    if (a == b) continue;
    parent[a] = b;
    ++num_joined;
  }
  return std::sqrt(weight * num_joined / static_cast<double>(pairs.size()));
}

}  // namespace

void AddValueRows(const Scene& scene, const ParameterLayout& layout, const Prior& prior,
                  Rows* of_block) {
  CheckNumbers(prior);
  bool is_estimated = false;
  int num_rows = 0;
  for (size_t b = 0; b < layout.blocks().size(); ++b) {
    const ParameterBlock& block = layout.blocks()[b];
    if (!IsOf(block, prior.kind, prior.object)) continue;
    is_estimated = true;
    const std::vector<char> chosen = Chosen(scene, prior, block);
    PriorRows::Row row;
    row.scale = 1.0 / prior.spread;
    row.centre = prior.centre;
    if (prior.distribution == PriorDistribution::kLogNormal) {
      row.centre = std::log(prior.centre);
    } else {
      row.is_exponential = ParameterKindIsPositive(prior.kind);
    }
    for (int k = 0; k < block.size; ++k) {
      if (!chosen[k]) continue;
      row.a = block.offset + k;
      (*of_block)[b].push_back(row);
      ++num_rows;
    }
  }
  if (!is_estimated) {
    Refuse("prior", PriorText(prior), "that is not estimated",
           WhatIsEstimated(layout, false));
  }
  if (num_rows == 0) {
    Refuse("prior", PriorText(prior),
           "no unknown of the " + ParameterKindName(prior.kind) + " is of \"" +
               prior.part + "\"",
           "a part that the object has");
  }
}

void AddDifferenceRows(const Scene& scene, const ParameterLayout& layout,
                       const SmoothnessPrior& smoothness, Rows* of_block) {
  if (!(smoothness.weight > 0.0) || !std::isfinite(smoothness.weight)) {
    Refuse("smoothness", SmoothnessText(smoothness), "the weight is not above 0",
           "a finite number above 0");
  }
  int num_rows = 0;
  for (size_t b = 0; b < layout.blocks().size(); ++b) {
    const ParameterBlock& block = layout.blocks()[b];
    if (!IsOf(block, smoothness.kind, smoothness.object) ||
        block.mode != ParameterMode::kLocal) {
      continue;
    }
    const Neighbours neighbours =
        FindNeighbours(scene.objects[block.object], smoothness.kind);
    std::vector<PriorRows::Row> rows;
    for (const auto& [first, second] : neighbours.pairs) {
      const int a = block.element_to_local[first];
      const int other = block.element_to_local[second];
      if (a < 0 || other < 0) continue;  // without influence, hence not estimated
      PriorRows::Row row;
      row.a = block.offset + a;
      row.b = block.offset + other;
      row.centre = neighbours.log_shape[first] - neighbours.log_shape[second];
      rows.push_back(row);
    }
    const double scale =
        DifferenceScale(smoothness.weight, block.size, rows, block.offset);
    for (PriorRows::Row& row : rows) {
      row.scale = scale;
      (*of_block)[b].push_back(row);
      ++num_rows;
    }
  }
  if (num_rows == 0) {
    Refuse("smoothness", SmoothnessText(smoothness),
           "that is not estimated per element (mode L) or has no neighbours",
           WhatIsEstimated(layout, true));
  }
}

}  // namespace dpe
