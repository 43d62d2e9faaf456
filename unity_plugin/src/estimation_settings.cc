#include "estimation_settings.h"

#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <utility>
#include <vector>

#include "call.h"

namespace dpe::c {
namespace {

template <class Value>
using Choices = std::vector<std::pair<const char*, Value>>;

template <class Value>
Value Choose(const std::string& name, const std::string& value,
             const Choices<Value>& choices) {
  std::string accepted;
  for (const auto& choice : choices) {
    if (value == choice.first) return choice.second;
    accepted += (accepted.empty() ? "" : ", ") + std::string(choice.first);
  }
  throw SceneError(name + ": \"" + value + "\" is not accepted; expected one of " +
                   accepted);
}

std::vector<std::string> SplitAtCommas(const std::string& text) {
  std::vector<std::string> parts;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    parts.push_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  return parts;
}

std::vector<std::string> OneOrNone(const std::string& text) {
  return text.empty() ? std::vector<std::string>() : std::vector<std::string>{text};
}

using TextSetter = std::function<void(const std::string&, EstimationJob*)>;

const std::map<std::string, TextSetter>& TextSetters() {
  static const std::map<std::string, TextSetter> setters = {
      {"scene", [](auto& v, auto* job) { job->scene_paths = OneOrNone(v); }},
      {"target", [](auto& v, auto* job) { job->target_paths = OneOrNone(v); }},
      {"settings", [](auto& v, auto* job) { job->settings = v; }},
      {"estimate", [](auto& v, auto* job) { job->estimate = SplitAtCommas(v); }},
      {"output_dir", [](auto& v, auto* job) { job->output_dir = v; }},
      {"solver",
       [](auto& v, auto* job) {
         job->options.solver =
             Choose<SolverType>("solver", v,
                                {{"auto", SolverType::kAuto},
                                 {"lm", SolverType::kLevenbergMarquardt},
                                 {"lbfgs", SolverType::kLbfgs}});
       }},
      {"init",
       [](auto& v, auto* job) {
         job->options.init =
             Choose<InitMethod>("init", v,
                                {{"auto", InitMethod::kAuto},
                                 {"inverse_dynamics", InitMethod::kInverseDynamics},
                                 {"scene", InitMethod::kScene},
                                 {"screen", InitMethod::kScreen}});
       }},
      {"horizon",
       [](auto& v, auto* job) {
         job->options.horizon = Choose<Horizon>("horizon", v,
                                                {{"auto", Horizon::kAuto},
                                                 {"full", Horizon::kFull},
                                                 {"grow", Horizon::kGrow},
                                                 {"shooting", Horizon::kShooting}});
       }},
      {"uncertainty",
       [](auto& v, auto* job) {
         job->options.uncertainty =
             Choose<UncertaintyMode>("uncertainty", v,
                                     {{"auto", UncertaintyMode::kAuto},
                                      {"on", UncertaintyMode::kOn},
                                      {"off", UncertaintyMode::kOff}});
       }},
  };
  return setters;
}

struct NumberSetter {
  double least, most;
  bool is_whole;
  std::function<void(double, EstimationJob*)> set;
};

const std::map<std::string, NumberSetter>& NumberSetters() {
  constexpr double kMostInt = std::numeric_limits<int>::max();
  constexpr double kMostWhole = 9007199254740992.0;  // 2^53
  static const std::map<std::string, NumberSetter> setters = {
      {"frames",
       {0, kMostInt, true,
        [](double v, auto* job) { job->num_frames = static_cast<int>(v); }}},
      {"validate_frames",
       {0, kMostInt, true,
        [](double v, auto* job) { job->num_validation_frames = static_cast<int>(v); }}},
      {"max_iterations",
       {-1, kMostInt, true,
        [](double v, auto* job) {
          job->options.max_iterations = static_cast<int>(v);
        }}},
      {"max_seconds",
       {0, 1e9, false, [](double v, auto* job) { job->options.max_seconds = v; }}},
      {"threads",
       {1, 1024, true,
        [](double v, auto* job) { job->options.num_threads = static_cast<int>(v); }}},
      {"sigma", {0, 1e9, false, [](double v, auto* job) { job->sigma = v; }}},
      {"noise_sigma",
       {0, 1e9, false, [](double v, auto* job) { job->noise_sigma = v; }}},
      {"seed",
       {0, kMostWhole, true,
        [](double v, auto* job) {
          job->noise_seed = job->options.seed = static_cast<std::uint64_t>(v);
        }}},
      {"follow_pins",
       {0, 1, true, [](double v, auto* job) { job->target.follow_pins = v != 0; }}},
      {"start_from_target",
       {0, 1, true,
        [](double v, auto* job) { job->target.start_from_target = v != 0; }}},
  };
  return setters;
}

template <class Setters>
auto FindSetter(const Setters& setters, const std::string& name) {
  const auto found = setters.find(name);
  if (found != setters.end()) return found;
  std::string accepted;
  for (const auto& setter : setters) {
    accepted += (accepted.empty() ? "" : ", ") + setter.first;
  }
  throw ApiError(DPE_ERROR_ARGUMENT,
                 "there is no option \"" + name + "\"; accepted are " + accepted);
}

}  // namespace

void SetText(const std::string& name, const std::string& value, EstimationJob* job) {
  FindSetter(TextSetters(), name)->second(value, job);
}

void SetNumber(const std::string& name, double value, EstimationJob* job) {
  const NumberSetter& setter = FindSetter(NumberSetters(), name)->second;
  const bool is_accepted = value >= setter.least && value <= setter.most &&
                           (!setter.is_whole || value == std::floor(value));
  if (!is_accepted) {
    throw ApiError(
        DPE_ERROR_ARGUMENT,
        name + ": " + std::to_string(value) + " is not accepted; expected a " +
            (setter.is_whole ? "whole " : "") + "number from " +
            std::to_string(setter.least) + " to " + std::to_string(setter.most));
  }
  setter.set(value, job);
}

}  // namespace dpe::c
