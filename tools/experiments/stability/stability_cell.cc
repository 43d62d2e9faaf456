#include "experiments/stability/stability_cell.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "dpe/engine/simulator.h"
#include "experiments/stability/contact.h"
#include "experiments/stability/reference.h"
#include "experiments/stability/stability_scene.h"
#include "experiments/stability/step_limit.h"

namespace dpe::experiments {
namespace {

// The Krylov method's relative residual: derivatives are exact to it.
constexpr double kTolerance = 1e-10;

// Predictions closer to the limit than this are of either kind.
constexpr double kNearLimit = 0.1;
// A mode that grows by less over the rollout may go unseen, one that grows by more not.
constexpr double kSeenGrowth = 1e6;

// An error as large as the motion leaves nothing of it: growth that ended with a
// contact has got that far.
constexpr double kNothingLeft = 1.0;

const double kNan = std::numeric_limits<double>::quiet_NaN();

bool IsExplicit(IntegrationMethod method) {
  return method == IntegrationMethod::kExplicitEuler ||
         method == IntegrationMethod::kSymplecticEuler;
}

StabilityScene SceneOf(const StabilityCell& cell) {
  StabilityScene s = MakeStabilityScene(cell.axis, cell.value);
  s.scene.integration_method = cell.method;
  s.scene.solver = cell.solver;
  s.scene.tolerance = kTolerance;
  return s;
}

Scene Shifted(const StabilityScene& s) {
  Scene scene = s.scene;
  Eigen::VectorXd& x = scene.objects[0].positions;
  // Springs keep their lengths, which a shift rounds.
  scene.objects[0].rest_length = RestLengths(s.scene.objects[0]);
  for (int i = 0; i < x.size(); ++i) x[i] += s.shift[i % 3];
  return scene;
}

// Where the motion would be had the origin not been shifted.
Eigen::MatrixXd Unshifted(const StabilityScene& s, const Trajectory& trajectory) {
  Eigen::MatrixXd x = trajectory.positions[0];
  for (int i = 0; i < x.rows(); ++i) x.row(i).array() -= s.shift[i % 3];
  return x;
}

// Returns true if the rollout is stable.
bool Judge(const StabilityScene& s, const Trajectory& trajectory,
           const Reference& reference, Record* row) {
  if (!trajectory.status.ok()) {
    row->Set("result", "failed");
    row->Set("why", trajectory.status.Message());
    row->Set("failed_frame", trajectory.status.frame);
    row->Set("failed_step", trajectory.status.step);
    return false;
  }
  const Eigen::MatrixXd x = Unshifted(s, trajectory);
  if (!x.allFinite()) {
    row->Set("result", "silent");
    row->Set("why", "the status is ok, but the states are not finite");
    return false;
  }
  if (!reference.available) {
    row->Set("result", "undecided");
    row->Set("why", "no method could make a reference");
    return true;
  }
  const ClothObject& object = s.scene.objects[0];
  const double error = RmsDifference(object, x, reference.positions) / reference.motion;
  const double uncertainty = reference.error / reference.motion;
  row->Set("error", error);
  if (error > kBlownUp) {
    row->Set("result", "blown_up");
    return false;
  }
  if (error + uncertainty <= kAccurate) {
    row->Set("result", "accurate");
  } else if (error - uncertainty > kAccurate) {
    row->Set("result", "inaccurate");
  } else {
    row->Set("result", "undecided");
    char why[120];
    std::snprintf(why, sizeof(why),
                  "off by %.2g of the motion, and the reference by up to %.2g", error,
                  uncertainty);
    row->Set("why", why);
  }
  return true;
}

// @param error  of the motion if it is stable, as a fraction of the motion
std::string Agreement(const StepLimit& limit, double h, double growth, bool is_stable,
                      double error) {
  if (std::abs(h / limit.limit - 1.0) <= kNearLimit) return "at the limit";
  if (h < limit.limit) return is_stable ? "agrees" : "disagrees";
  const bool is_seen = !is_stable || error > kNothingLeft;
  if (is_seen) return growth > 1.5 ? "agrees" : "disagrees";
  return growth < kSeenGrowth ? "too slow to see" : "disagrees";
}

// The states of a rollout up to the first that is further from the start than the
// reference's motion by kBlownUp: what comes after has nothing to do with the scene.
Eigen::MatrixXd Sensible(const StabilityScene& s, const Eigen::MatrixXd& positions,
                         const Reference& reference) {
  const ClothObject& object = s.scene.objects[0];
  Eigen::Index end = 0;
  while (end < positions.cols() && positions.col(end).allFinite() &&
         RmsDifference(object, positions.col(end), object.positions) <=
             kBlownUp * reference.motion) {
    ++end;
  }
  return positions.leftCols(end);
}

void AddPrediction(const StabilityScene& s, const Reference& reference,
                   const Eigen::MatrixXd& own, bool is_stable, Record* row) {
  const StepLimit limit = PredictStepLimitAlong(s.scene, reference.positions, own);
  const double h = s.scene.step_length();
  const int steps = (s.num_frames - 1) * s.scene.steps_per_frame;
  const double growth = std::exp(std::min(steps * std::log(limit.factor), 690.0));
  row->Set("omega_max", limit.omega_max);
  row->Set("limit", limit.limit);
  row->Set("growth", growth);
  row->Set("prediction", h < limit.limit ? "stable" : "unstable");
  // A force without a value says nothing about steps.
  const bool is_undefined =
      row->Text("why", "").find("are in the same place") != std::string::npos;
  row->Set("agreement", is_undefined ? "another failure"
                                     : Agreement(limit, h, growth, is_stable,
                                                 row->Number("error", 0.0)));
}

void AddGradient(const Scene& shifted, int num_frames,
                 const DerivativeFunction& derivatives, Record* row) {
  Scene scene = shifted;
  EstimateForCheck(&scene);
  const GradientCheck check = CheckGradient(scene, num_frames, derivatives);
  row->Set("gradient", GradientVerdictName(check.verdict));
  row->Set("gradient_why", check.why);
  row->Set("gradient_error", check.error);
  row->Set("gradient_noise", check.noise);
  row->Set("gradient_identity", check.identity);
  row->Set("directions_right", check.right);
  row->Set("directions_undecidable", check.undecidable);
  row->Set("directions_wrong", check.wrong);
}

// All columns, so that every row has them in this order.
Record EmptyRow() {
  Record row;
  for (const char* text : {"result", "why"}) row.Set(text, "");
  for (const char* number : {"failed_frame", "failed_step"}) row.Set(number, -1);
  for (const char* number : {"error", "reference_error", "motion", "penetration"}) {
    row.Set(number, kNan);
  }
  row.Set("reference", "");
  for (const char* number : {"omega_max", "limit", "growth"}) row.Set(number, kNan);
  for (const char* text : {"prediction", "agreement", "gradient", "gradient_why"}) {
    row.Set(text, "");
  }
  for (const char* number : {"gradient_error", "gradient_noise", "gradient_identity"}) {
    row.Set(number, kNan);
  }
  for (const char* count :
       {"directions_right", "directions_undecidable", "directions_wrong"}) {
    row.Set(count, 0);
  }
  return row;
}

void AddReference(const Reference& reference, Record* row) {
  if (!reference.available) return;
  row->Set("motion", reference.motion);
  row->Set("reference_error", reference.error / reference.motion);
  row->Set("reference", IntegrationMethodName(reference.method) + " / " +
                            std::to_string(reference.refinement));
}

}  // namespace

Record RunStabilityCell(const StabilityCell& cell,
                        const DerivativeFunction& derivatives) {
  Record row = EmptyRow();
  try {
    const StabilityScene s = SceneOf(cell);
    const Scene shifted = Shifted(s);
    const Trajectory trajectory = Simulator(shifted).Simulate(s.num_frames);
    const Reference reference =
        ComputeReference(s.scene, s.num_frames, 0.2 * kAccurate);
    AddReference(reference, &row);
    const bool is_stable = Judge(s, trajectory, reference, &row);
    const Eigen::MatrixXd own = Sensible(s, Unshifted(s, trajectory), reference);
    if (!s.scene.colliders.empty()) {
      row.Set("penetration", ContactProbe(s.scene).Deepest(own));
    }
    if (IsExplicit(cell.method)) AddPrediction(s, reference, own, is_stable, &row);
    if (is_stable) AddGradient(shifted, s.gradient_frames, derivatives, &row);
  } catch (const SceneError& error) {
    row.Set("result", "refused");
    row.Set("why", error.what());
  }
  return row;
}

}  // namespace dpe::experiments
