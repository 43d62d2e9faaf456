#include "common_values.h"

#include "better_basins.h"
#include "dpe/estimation/joint_layout.h"
#include "starting_point.h"

namespace dpe {
namespace {

bool HasOneUnknownPerElement(const ParameterBlock& block) {
  return block.mode == ParameterMode::kLocal && block.size > 1 &&
         ParameterKindIsPositive(block.kind);
}

void UseOneValue(ParameterMode* mode) {
  if (*mode == ParameterMode::kLocal) *mode = ParameterMode::kGlobal;
}

// The same motions with one unknown per block; the scenes hold the values of `joint`.
std::vector<FitCapture> WithOneValue(std::vector<FitCapture> captures,
                                     const JointLayout& joint,
                                     const Eigen::VectorXd& parameters) {
  for (size_t c = 0; c < captures.size(); ++c) {
    Scene& scene = captures[c].blank;
    joint.layout().Insert(parameters, &scene, static_cast<int>(c));
    for (ClothObject& object : scene.objects) {
      UseOneValue(&object.mass_mode);
      UseOneValue(&object.stiffness_mode);
    }
  }
  return captures;
}

// Down from `start`, and from trial values over the whole range as long as there are
// few parameters and one of them is better.
// @return  false if no point that was tried can be simulated
bool Fit(const Eigen::VectorXd& start, OptimizerContext* context) {
  TrajectoryEvaluator* evaluator = context->fit->evaluator();
  const bool are_few =
      evaluator->num_parameters() <= context->options->max_checked_parameters;
  Eigen::VectorXd next = start;
  if (!evaluator->Evaluate(start)) {
    if (!are_few) return false;
    const StartingPoint screened = ScreenStartingPoints(context->stop, evaluator);
    if (!screened.ok) return false;
    next = screened.coordinates;
  }
  context->problem()->set_coordinates(next);
  if (!evaluator->Evaluate(next)) return false;
  EstimatorSummary summary;
  const auto minimise = [&] {
    const OptimizerResult result = Minimize(/*use_lm=*/true, context);
    summary.termination = result.termination;
  };
  if (!context->fit->IsAtRounding()) minimise();
  if (are_few && !context->is_over()) {
    // Where a few frames leave a valley, its end is no better a start than this.
    SearchBetterBasins({context->fit, context->stop, minimise, &summary,
                        /*along_valleys=*/false});
  }
  return evaluator->best_coordinates().size() > 0;
}

}  // namespace

bool StartsWithCommonValues(const TrajectoryEvaluator& evaluator,
                            const Eigen::VectorXd& coordinates) {
  bool has_some = false;
  for (const ParameterBlock& block : evaluator.layout().blocks()) {
    if (!HasOneUnknownPerElement(block)) continue;
    has_some = true;
    const auto values = coordinates.segment(block.offset, block.size);
    if (values.minCoeff() != values.maxCoeff()) return false;
  }
  return has_some;
}

CommonValues FitCommonValues(const std::vector<FitCapture>& captures,
                             const TrajectoryEvaluator& all,
                             const Eigen::VectorXd& start, OptimizerContext* context) {
  CommonValues result;
  result.coordinates = start;
  const JointLayout& joint = all.joint_layout();
  std::vector<FitCapture> simpler =
      WithOneValue(captures, joint, all.map().ToParameters(start));
  EstimatorOptions options = *context->options;
  options.priors.clear();
  options.smoothness.clear();
  FitProblem fit(simpler, options, context->stop);
  TrajectoryEvaluator* evaluator = fit.evaluator();
  const JointLayout& common = evaluator->joint_layout();
  OptimizerContext own = *context;
  own.fit = &fit;
  own.options = &options;
  own.first_iteration = own.num_iterations;
  own.accepted = nullptr;  // a fit that is continued does this again
  if (Fit(evaluator->map().ToCoordinates(common.Extract(ScenesOf(simpler))), &own)) {
    const Eigen::VectorXd found =
        evaluator->map().ToParameters(evaluator->best_coordinates());
    for (size_t c = 0; c < simpler.size(); ++c) {
      common.layout().Insert(found, &simpler[c].blank, static_cast<int>(c));
    }
    result.coordinates = all.map().ToCoordinates(joint.Extract(ScenesOf(simpler)));
    result.ok = true;
  }
  context->num_iterations = own.num_iterations;
  result.num_rollouts = evaluator->num_rollouts();
  result.num_derivative_passes = evaluator->num_derivative_passes();
  return result;
}

}  // namespace dpe
