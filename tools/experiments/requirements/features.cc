#include "experiments/requirements/features.h"

#include <cmath>
#include <cstdio>
#include <map>

#include "experiments/requirements/cost_job.h"

namespace dpe::experiments {
namespace {

const char kCaption[] =
    "What a feature costs when it is absent and when it is present. *Off / impossible* "
    "compares the instructions of a run that turns the feature off with one whose "
    "scene "
    "or command line does not mention it: 1 is nothing. *Own code, off* and *on* are "
    "instructions in functions that belong to the feature alone, where it has any that "
    "the compiler does not spread over others. *On / off* is what you pay in "
    "instructions, *ms per frame* in processor time (the least of several runs; what "
    "is "
    "a few per cent of the column beside it is noise). The first rows are simulations "
    "of 12 x 12 vertices, bare springs under gravity but for the feature; those of "
    "fits "
    "are one iteration of Levenberg-Marquardt (two rollouts, two Jacobians) with 6 x 6 "
    "vertices and all forces, their time is that of a frame of a rollout with its "
    "share "
    "of the derivatives. What is estimated is compared with a fit of the damping "
    "alone. "
    "A quantity that is not estimated exists all the same, so none of these is "
    "impossible; its own code is its derivative. What to make of it: damping makes the "
    "matrix of a step unsymmetric and costs as much as drag; one value (G) or one per "
    "group (R) is nearly free to estimate, one per element (L) is what fits spend "
    "their "
    "time on, and smoothness and error bars for them are paid once per fit; wind, "
    "colliders, checkpoints, priors, robust losses and the printing of times need not "
    "be left out for the sake of speed. `--uncertainty off` also leaves out the report "
    "of how much the motion depends on its start, which `auto` keeps.";

std::string Format(const char* format, double value) {
  if (!std::isfinite(value)) return "–";
  char text[32];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

// The rows of a campaign by their id.
class Costs {
 public:
  explicit Costs(const std::vector<Row>& rows) {
    for (const Row& row : rows) rows_[row.Text("id", "")] = &row;
  }

  // `missing` where there is none: it failed, or there is no such configuration.
  double Number(const std::string& id, const std::string& key,
                double missing = std::nan("")) const {
    const auto found = rows_.find(id);
    return found == rows_.end() ? missing : found->second->Number(key, missing);
  }
  double Instructions(const std::string& id) const {
    return Number(id, "instructions");
  }
  // Own code of a feature: NaN where it has none.
  double Code(const std::string& id, const std::string& code) const {
    return code.empty() ? std::nan("") : Number(id, "code_" + code);
  }
  double MillisecondsPerFrame(const std::string& id) const {
    return 1e3 * Number(id, "program_cpu_s") /
           (Number(id, "time_frames", kTimeFrames) * Number(id, "rollouts"));
  }

 private:
  std::map<std::string, const Row*> rows_;
};

std::vector<std::string> Cells(const Feature& feature, const Costs& costs) {
  const std::string& without = feature.without.empty() ? feature.off : feature.without;
  const double on = costs.Instructions(feature.on);
  const double off = costs.Instructions(feature.off);
  return {feature.name,
          Format("%.5f", off / costs.Instructions(feature.impossible)),
          Format("%.0f", costs.Code(feature.off, feature.code)),
          Format("%.0f", costs.Code(feature.on, feature.code)),
          Format("%.3f", on / costs.Instructions(without)),
          Format("%.4f", costs.MillisecondsPerFrame(without)),
          Format("%+.4f", costs.MillisecondsPerFrame(feature.on) -
                              costs.MillisecondsPerFrame(without))};
}

Results FeatureResults(const std::vector<Row>& rows) {
  const Costs costs(rows);
  Table table;
  table.name = "only_what_it_requires";
  table.caption = kCaption;
  table.columns = {
      "feature",  "off / impossible",  "own code, off",        "own code, on",
      "on / off", "ms per frame, off", "ms per frame more, on"};
  Series bars;
  bars.label = "instructions with the feature / without";
  bars.line = false;
  for (const Feature& feature : ComparedFeatures()) {
    table.cells.push_back(Cells(feature, costs));
    const std::string& without =
        feature.without.empty() ? feature.off : feature.without;
    bars.x.push_back(costs.Instructions(feature.on) / costs.Instructions(without));
    bars.y.push_back(static_cast<double>(ComparedFeatures().size() - bars.y.size()));
    bars.annotations.push_back(feature.name);
  }
  Plot plot;
  plot.name = "only_what_it_requires";
  plot.title = "What a feature costs where it is present";
  plot.x_label = "instructions, with the feature / without";
  plot.y_label = "feature (row of the table, from the bottom)";
  plot.series = {bars};
  return {{table}, {plot}};
}

}  // namespace

const std::vector<Feature>& ComparedFeatures() {
  static const std::vector<Feature> features = {
      {"drag", "sim-bare", "sim-drag_off", "sim-drag_on", "drag", ""},
      {"wind", "sim-wind_unmentioned", "sim-drag_on", "sim-wind_on", "", ""},
      {"damping", "sim-unmentioned", "sim-bare", "sim-damping_on", "", ""},
      {"collider, not touched", "sim-bare", "sim-collider_soft", "sim-collider_far",
       "collider", "sim-bare"},
      {"collider, in contact", "sim-bare", "sim-collider_soft", "sim-collider_contact",
       "collider", "sim-bare"},
      {"second object, simulated", "", "sim-bare", "sim-two_objects", "", ""},
      {"printing of times, simulation", "sim-bare", "sim-times_off", "sim-times_on", "",
       ""},
      {"second object, fitted", "fit-stiffness_alone", "fit-second_fixed",
       "fit-second_on", "", ""},
      {"mass G", "", "fit-damping", "fit-mass_G", "mass_derivative", ""},
      {"mass R (2)", "", "fit-damping", "fit-mass_R", "mass_derivative", ""},
      {"mass L (30)", "", "fit-damping", "fit-mass_L", "mass_derivative", ""},
      {"stiffness G", "", "fit-damping", "fit-stiffness_G", "", ""},
      {"stiffness R (3)", "", "fit-damping", "fit-stiffness_R", "", ""},
      {"stiffness L (145)", "", "fit-damping", "fit-stiffness_L", "", ""},
      {"damping, estimated", "", "fit-stiffness_alone", "fit-stiffness_G", "", ""},
      {"drag, estimated", "", "fit-damping", "fit-drag", "drag_derivative", ""},
      {"wind, estimated", "", "fit-damping", "fit-wind", "drag_derivative", ""},
      {"initial velocity, estimated", "", "fit-damping", "fit-initial_velocity", "",
       ""},
      {"validation over 200 frames", "fit-validation_unmentioned", "fit-validation_off",
       "fit-validation_on", "", ""},
      {"report of the sensitivity to the start", "", "fit-uncertainty_off",
       "fit-uncertainty_auto", "", ""},
      {"uncertainty (145)", "", "fit-uncertainty_auto", "fit-uncertainty_on",
       "uncertainty", ""},
      {"checkpoints", "fit-stiffness_alone", "fit-checkpoint_off", "fit-checkpoint_on",
       "checkpoint", ""},
      {"printing of times, fit", "fit-stiffness_alone", "fit-times_off", "fit-times_on",
       "", ""},
      {"robust loss", "fit-sigma", "fit-loss_off", "fit-loss_on", "robust_loss", ""},
      {"prior", "fit-sigma", "fit-prior_off", "fit-prior_on", "prior", ""},
      {"smoothness (145)", "fit-sigma_L", "fit-smoothness_off", "fit-smoothness_on",
       "prior", ""},
  };
  return features;
}

Experiment OnlyWhatItRequires() {
  return {"only_what_it_requires",
          "what each feature costs, in instructions and in time, when it is absent and "
          "when it is present (needs valgrind)",
          "Only what it requires: the price of each feature", CostConfigurations,
          FeatureResults};
}

}  // namespace dpe::experiments
