// Directions in words.
#include <algorithm>
#include <cmath>

#include "uncertainty_directions.h"
#include "uncertainty_names.h"

namespace dpe {
namespace {

// Parts named in a sentence about more than a handful.
constexpr size_t kNamedParts = 3;

// "+1 %" or "-0.05 m/s": the part of a change of one per cent of the natural unit.
std::string Change(const NaturalSpace& space, int parameter, double coefficient) {
  const std::string sign = coefficient < 0.0 ? "-" : "+";
  const double size = std::abs(coefficient);
  const ParameterKind kind = space.kind[parameter];
  if (ParameterKindIsPositive(kind)) return sign + Short(size) + " %";
  return sign + Spread(kind, 0.01 * size, space.unit[parameter]);
}

std::string Parts(const NaturalSpace& space, const std::vector<std::string>& names,
                  const UndeterminedDirection& direction, size_t count) {
  std::vector<std::string> parts;
  for (size_t k = 0; k < std::min(count, direction.parameters.size()); ++k) {
    const int j = direction.parameters[k];
    parts.push_back(names[j] + " by " + Change(space, j, direction.coefficients[k]));
  }
  return Listed(parts);
}

// "mass and stiffness of object 0", "the mass of object 0 and the wind strength".
std::string Blocks(const NaturalSpace& space, const std::vector<int>& blocks) {
  std::vector<std::string> quantities, with_object;
  bool one_object = true;
  const std::string owner = OfBlock(space.layout.blocks()[blocks[0]]);
  for (const int b : blocks) {
    const ParameterBlock& block = space.layout.blocks()[b];
    one_object &= OfBlock(block) == owner;
    quantities.push_back(BlockQuantity(block.kind));
    with_object.push_back("the " + quantities.back() + OfBlock(block));
  }
  return one_object ? Listed(quantities) + owner : Listed(with_object);
}

std::string BlockChanges(const NaturalSpace& space, const ReadableDirection& readable) {
  std::vector<std::string> parts;
  for (size_t k = 0; k < readable.blocks.size(); ++k) {
    const ParameterBlock& block = space.layout.blocks()[readable.blocks[k]];
    parts.push_back("the " + BlockQuantity(block.kind) + OfBlock(block) + " by " +
                    (readable.powers[k] < 0.0 ? "-" : "+") +
                    Short(std::abs(readable.powers[k])) + " %");
  }
  return Listed(parts);
}

// What moves, and what that does to the observations, for an exact direction; of a
// weak one the same with its spread.
struct Phrase {
  std::string subject, if_exact, if_weak;
};

Phrase PhraseOf(const NaturalSpace& space, const std::vector<std::string>& names,
                const ReadableDirection& readable,
                const UndeterminedDirection& direction) {
  static const char* const kNone = " has no effect on what was observed";
  static const char* const kHardly =
      " has hardly any effect on what was observed: this combination is known only to ";
  const std::string many = readable.blocks.size() > 2 ? "ratios" : "ratio";
  switch (readable.pattern) {
    case DirectionPattern::kSingle:
      return {names[direction.parameters[0]], kNone,
              " is weakly determined: it is known only to "};
    case DirectionPattern::kRatio:
      if (readable.blocks.size() == 1) {
        return {"the " + Blocks(space, readable.blocks) + " as a whole",
                kNone + std::string(": only ratios within it were determined"),
                " is weakly determined: a common factor is known only to "};
      }
      return {Blocks(space, readable.blocks),
              " scale together: only their " + many +
                  (readable.blocks.size() > 2 ? " were" : " was") + " determined",
              " scale together: beside their " + many +
                  ", a common factor is known only to "};
    case DirectionPattern::kProduct:
      return {Blocks(space, readable.blocks),
              " change against each other: only their product was determined",
              " change against each other: beside their product, a factor that "
              "multiplies one and divides the other is known only to "};
    case DirectionPattern::kBlocks:
      return {"changing " + BlockChanges(space, readable) + " together", kNone,
              kHardly};
    case DirectionPattern::kElements:
      return {"changing " +
                  Parts(space, names, direction, direction.parameters.size()) +
                  " together",
              kNone, kHardly};
    case DirectionPattern::kGeneral:
      break;
  }
  return {"a combination of " + std::to_string(direction.num_parameters) +
              " parameters, mostly of changing " +
              Parts(space, names, direction, kNamedParts) + ",",
          kNone, kHardly};
}

}  // namespace

std::string DirectionPatternName(DirectionPattern pattern) {
  switch (pattern) {
    case DirectionPattern::kSingle:
      return "single";
    case DirectionPattern::kRatio:
      return "ratio";
    case DirectionPattern::kProduct:
      return "product";
    case DirectionPattern::kBlocks:
      return "blocks";
    case DirectionPattern::kElements:
      return "elements";
    case DirectionPattern::kGeneral:
      break;
  }
  return "general";
}

std::string DirectionText(const NaturalSpace& space,
                          const std::vector<std::string>& names,
                          const ReadableDirection& readable,
                          const UndeterminedDirection& direction) {
  const Phrase phrase = PhraseOf(space, names, readable, direction);
  const int largest = direction.parameters[0];
  const auto spread = [&](double std) {
    return Spread(space.kind[largest], std, space.unit[largest]);
  };
  std::string text = phrase.subject;
  text += direction.is_exact ? phrase.if_exact
                             : phrase.if_weak + spread(direction.data_std);
  if (std::isfinite(direction.std) && direction.std < 0.5 * direction.data_std) {
    text += "; the prior fixes it to " + spread(direction.std);
  }
  return text;
}

}  // namespace dpe
