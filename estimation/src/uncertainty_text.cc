#include "uncertainty_text.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <sstream>

#include "uncertainty_names.h"

namespace dpe {
namespace {

// Parameters named in a sentence that holds for many.
constexpr size_t kNamed = 3;
// Directions without a pattern and correlated pairs in sentences; all that are reported
// stand in the Uncertainty itself.
constexpr int kMaxPatternless = 3;
constexpr size_t kMaxPairs = 3;
// Noise below this, m, is no measurement's.
constexpr double kRoundingNoise = 1e-10;

class StatementMaker {
 public:
  StatementMaker(const Uncertainty& uncertainty, const UncertaintyOptions& options)
      : uncertainty_(uncertainty), options_(options) {}

  std::vector<std::string> Make() {
    Noise();
    Correlation();
    Limits();
    SingleParameters();
    Directions();
    ForEachBlock(kPriorAlone, 0, [](const BlockUncertainty&, bool one) {
      return std::string(one ? " is determined by its prior alone"
                             : " are determined by their priors alone") +
             ": the data add next to nothing";
    });
    const std::vector<CorrelatedPair>& pairs = uncertainty_.strongest_pairs;
    for (size_t k = 0; k < std::min(kMaxPairs, pairs.size()); ++k) {
      statements_.push_back(pairs[k].text);
    }
    return statements_;
  }

 private:
  using Predicate = std::function<std::string(const BlockUncertainty&, bool is_one)>;

  void Noise() {
    std::ostringstream text;
    text.precision(3);
    if (!uncertainty_.noise_is_known) {
      text << "the noise was not given; the residuals make it " << uncertainty_.noise
           << " m per coordinate (square root of their sum of squares over "
           << uncertainty_.degrees_of_freedom << " degrees of freedom)";
      if (uncertainty_.noise < kRoundingNoise) {
        text << ", which is rounding error rather than noise of a measurement";
      }
    } else if (uncertainty_.degrees_of_freedom > 0) {
      const double ratio = std::sqrt(uncertainty_.reduced_chi_square);
      const double spread =
          std::sqrt(2.0 / static_cast<double>(uncertainty_.degrees_of_freedom));
      if (std::abs(uncertainty_.reduced_chi_square - 1.0) <= 5.0 * spread) return;
      text << "the residuals are " << ratio << " times as large as the noise given ("
           << uncertainty_.degrees_of_freedom << " degrees of freedom): ";
      if (ratio > 1.0) {
        text << "the model does not explain the motion to within the noise, or there "
                "is more noise; the standard deviations do not include that";
      } else {
        text << "there is less noise than given, and the standard deviations are too "
                "large accordingly";
      }
    }
    if (!text.str().empty()) statements_.push_back(text.str());
  }

  // With errors that go on like those of an autoregressive process of first order, n
  // residuals are worth n (1 - rho) / (1 + rho) independent ones.
  void Correlation() {
    const double rho = uncertainty_.residual_correlation;
    if (rho <= 0.0) return;
    if (!uncertainty_.noise_is_known && uncertainty_.noise < kRoundingNoise) return;
    statements_.push_back(
        "the residuals of a frame and the next are correlated (" + Short(rho) +
        "): they are errors of the model rather than noise, and the standard "
        "deviations, which take them for noise, are too small by a factor of about " +
        Short(std::sqrt((1.0 + rho) / std::max(1.0 - rho, 1e-6))));
  }

  // One sentence per block and number of parameters with flag `with` and none of
  // `without`.
  void ForEachBlock(unsigned with, unsigned without, const Predicate& predicate) {
    size_t offset = 0;
    for (const BlockUncertainty& block : uncertainty_.blocks) {
      std::vector<std::string> names;
      for (size_t k = 0; k < block.flags.size(); ++k) {
        if ((block.flags[k] & with) != with || (block.flags[k] & without) != 0)
          continue;
        names.push_back(uncertainty_.names[offset + k]);
      }
      offset += block.flags.size();
      if (names.empty()) continue;
      const bool is_one = names.size() == 1;
      if (names.size() > kNamed + 1) {
        const std::string rest = std::to_string(names.size() - kNamed) +
                                 " more of the " + std::to_string(block.flags.size()) +
                                 " unknowns of the " + block.kind;
        names.resize(kNamed);
        names.push_back(rest);
      }
      statements_.push_back(Listed(names) + predicate(block, is_one));
    }
  }

  void Limits() {
    size_t offset = 0;
    for (const BlockUncertainty& block : uncertainty_.blocks) {
      for (size_t k = 0; k < block.flags.size(); ++k) {
        const unsigned flags = block.flags[k];
        if ((flags & (kAtLowerLimit | kAtUpperLimit)) == 0) continue;
        const bool is_low = (flags & kAtLowerLimit) != 0;
        const std::string unit = block.unit == "1" ? "" : " " + block.unit;
        std::string text = uncertainty_.names[offset + k] + " went to the " +
                           (is_low ? "lower" : "upper") + " end of its range (" +
                           Short(block.values[k]) + unit + "): ";
        text += is_low ? "zero explains what was observed as well"
                       : "any larger value explains what was observed as well";
        const double bound = block.values[k] + 2.0 * block.standard_deviations[k];
        if (is_low && std::isfinite(bound)) {
          text += ", and so does up to " + Short(bound) + unit +
                  " (two standard deviations)";
        }
        if (num_limits_++ < options_.max_directions) statements_.push_back(text);
      }
      offset += block.flags.size();
    }
    if (num_limits_ > options_.max_directions) {
      statements_.push_back(std::to_string(num_limits_ - options_.max_directions) +
                            " more parameters went to an end of their range");
    }
  }

  void SingleParameters() {
    const unsigned limits = kAtLowerLimit | kAtUpperLimit;
    ForEachBlock(kNoInfluence | kUndetermined, limits,
                 [](const BlockUncertainty&, bool one) {
                   return std::string(one ? " has" : " have") +
                          " no effect on what was observed: not determined";
                 });
    ForEachBlock(
        kWeaklyDetermined, limits | kNoInfluence,
        [&](const BlockUncertainty& block, bool one) {
          return (one ? " is" : " are") +
                 std::string(" weakly determined: the standard deviation is ") +
                 "beyond " + Threshold(block);
        });
  }

  std::string Threshold(const BlockUncertainty& block) const {
    const double threshold = options_.weak_threshold;
    if (!std::isnan(block.relative[0])) return RelativeSpread(threshold);
    return Short(threshold * block.natural_unit) + " " + block.unit;
  }

  // Of more than a single parameter.
  void Directions() {
    int num_exact = 0, num_weak = 0, num_patternless = 0;
    for (const UndeterminedDirection& direction : uncertainty_.directions) {
      if (direction.pattern == DirectionPattern::kGeneral &&
          ++num_patternless > kMaxPatternless) {
        continue;
      }
      ++(direction.is_exact ? num_exact : num_weak);
      if (direction.pattern == DirectionPattern::kSingle) continue;
      statements_.push_back(direction.text);
    }
    const int all_exact =
        static_cast<int>(uncertainty_.names.size()) - uncertainty_.rank;
    Further(all_exact - num_exact, "undetermined");
    Further(uncertainty_.num_weak_directions - num_weak, "weakly determined");
  }

  void Further(int count, const std::string& what) {
    if (count <= 0) return;
    statements_.push_back("and " + std::to_string(count) + " more " + what +
                          (count == 1 ? " direction" : " directions"));
  }

  const Uncertainty& uncertainty_;
  const UncertaintyOptions& options_;
  int num_limits_ = 0;
  std::vector<std::string> statements_;
};

// "0.1 +- 0.003 1/s (3 %)".
std::string WithDeviation(const BlockUncertainty& block, int k) {
  const std::string unit = block.unit == "1" ? "" : " " + block.unit;
  if (std::isinf(block.standard_deviations[k])) {
    const std::string value = Short(block.values[k]) + unit;
    if ((block.flags[k] & kNoInfluence) != 0) return value + " (not determined)";
    return value + " (not determined; +- " + Short(block.determined_part[k]) + unit +
           " but for what is undetermined)";
  }
  std::ostringstream text;
  text.precision(6);
  text << block.values[k] << " +- " << Short(block.standard_deviations[k]) << unit;
  if (std::isfinite(block.relative[k])) {
    text << " (" << Short(100.0 * block.relative[k]) << " %)";
  }
  return text.str();
}

// Least, median and greatest of many.
std::string Spreads(const BlockUncertainty& block) {
  const bool is_log = !std::isnan(block.relative[0]);
  std::vector<double> finite;
  for (int k = 0; k < block.values.size(); ++k) {
    const double value = is_log ? block.relative[k] : block.standard_deviations[k];
    if (std::isfinite(value)) finite.push_back(value);
  }
  std::sort(finite.begin(), finite.end());
  const auto spread = [&](double value) {
    return is_log ? RelativeSpread(value) : Short(value) + " " + block.unit;
  };
  const size_t num_rest = block.values.size() - finite.size();
  std::string text;
  if (!finite.empty()) {
    text = "standard deviation min " + spread(finite.front()) + ", median " +
           spread(finite[finite.size() / 2]) + ", max " + spread(finite.back());
  }
  if (num_rest == 0) return text;
  return text + (finite.empty() ? "" : "; ") + std::to_string(num_rest) +
         " not determined";
}

}  // namespace

std::vector<std::string> MakeStatements(const Uncertainty& uncertainty,
                                        const UncertaintyOptions& options) {
  return StatementMaker(uncertainty, options).Make();
}

std::string DeterminedText(const Uncertainty& uncertainty) {
  const unsigned not_determined =
      kNoInfluence | kUndetermined | kWeaklyDetermined | kAtLowerLimit | kAtUpperLimit;
  std::vector<std::string> others;
  int count = 0;
  for (const BlockUncertainty& block : uncertainty.blocks) {
    for (const unsigned flags : block.flags) {
      if ((flags & not_determined) != 0) others.push_back(uncertainty.names[count]);
      ++count;
    }
  }
  const std::string were_determined =
      count == 1 ? " parameter was determined" : " parameters were determined";
  if (others.empty()) {
    return (count == 1 ? "the" : "all " + std::to_string(count)) + were_determined;
  }
  std::string text = std::to_string(count - others.size()) + " of " +
                     std::to_string(count) + were_determined;
  if (others.size() > kNamed + 1) {
    const std::string rest = std::to_string(others.size() - kNamed) + " more";
    others.resize(kNamed);
    others.push_back(rest);
  }
  return text + ", not or hardly " + Listed(others);
}

std::vector<std::string> UncertaintyLines(const Uncertainty& uncertainty) {
  constexpr int kListed = 3;
  std::vector<std::string> lines;
  if (!uncertainty.ok) lines.push_back(uncertainty.message);
  size_t offset = 0;
  for (const BlockUncertainty& block : uncertainty.blocks) {
    const int size = static_cast<int>(block.values.size());
    if (size > kListed) {
      lines.push_back(
          (block.object < 0 ? "" : "object " + std::to_string(block.object) + " ") +
          block.kind + " (" + std::to_string(size) + "): " + Spreads(block));
    }
    for (int k = 0; k < size && size <= kListed; ++k) {
      lines.push_back(uncertainty.names[offset + k] + ": " + WithDeviation(block, k));
    }
    offset += size;
  }
  if (uncertainty.ok) lines.push_back(DeterminedText(uncertainty));
  lines.insert(lines.end(), uncertainty.statements.begin(),
               uncertainty.statements.end());
  if (!uncertainty.ok) {
    for (const UndeterminedDirection& direction : uncertainty.directions) {
      lines.push_back(direction.text);
    }
  }
  return lines;
}

}  // namespace dpe
