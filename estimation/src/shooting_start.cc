#include "shooting_start.h"

#include <sstream>

#include "dpe/estimation/multiple_shooting.h"

namespace dpe {
namespace {

std::string Describe(const MultipleShootingSummary& summary) {
  std::ostringstream text;
  text.precision(3);
  text << "multiple shooting: " << summary.num_windows << " windows of "
       << summary.window_frames << " frames, " << summary.stages.size()
       << (summary.stages.size() == 1 ? " stage" : " stages");
  if (!summary.stages.empty()) {
    text << ", the largest jump fell from " << summary.stages.front().largest_jump
         << " to " << summary.stages.back().largest_jump << " m";
  }
  return text.str() + "; " + summary.message;
}

}  // namespace

ShootingStart ShootForStart(const FitCapture& capture, const Eigen::VectorXd& start,
                            OptimizerContext* context) {
  const EstimatorOptions& estimator = *context->options;
  const ParameterMap& map = context->problem()->evaluator()->map();
  MultipleShootingOptions options;
  options.max_polish_iterations = 0;  // the fit itself does that
  options.evaluator = EvaluatorOptionsOf(estimator, context->stop);
  options.make_costs = [&](const Scene& scene, const Observations& observations,
                           int num_frames) {
    return MakePositionCosts(scene, observations, num_frames, CostOptionsOf(estimator));
  };
  options.progress = [&](double cost, double step_norm, bool accepted) {
    ++context->num_iterations;
    IterationReport report;
    report.iteration = context->num_iterations;
    report.cost = cost;
    report.step_norm = step_norm;
    report.step_accepted = accepted;
    context->Report(report);
  };
  const MultipleShootingSummary summary =
      MultipleShooting(capture.blank, capture.observations, capture.num_frames,
                       map.ToParameters(start), options);
  return {map.ToCoordinates(summary.parameters), {Describe(summary)}};
}

}  // namespace dpe
