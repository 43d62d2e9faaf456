#include "experiments/stability/gradient_check.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <random>

#include "dpe/engine/derivative_checker.h"

namespace dpe::experiments {
namespace {

constexpr double kDecidableNoise = 1e-4;
constexpr double kLeastTolerance = 1e-6;
constexpr double kNoiseMargin = 10.0;
constexpr double kIdentity = 1e-6;
constexpr double kWrongIdentity = 1e-4;
// At a kink the tangent is that of one side, or of between, give or take this factor.
constexpr double kKinkMargin = 1.5;
// A change of this many units of the last place of a position can be measured.
constexpr double kMeasurable = 1e4;
// A rollout of more frames than this is differenced at few steps only.
constexpr int kLongRollout = 500;

struct Direction {
  std::string name;
  Eigen::VectorXd d;  // one percent of it is a small change
};

std::vector<Direction> Directions(const ParameterLayout& layout,
                                  const Eigen::VectorXd& p) {
  std::vector<Direction> directions;
  std::mt19937 random(11);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  for (const ParameterBlock& block : layout.blocks()) {
    Direction direction;
    direction.name = ParameterKindName(block.kind);
    direction.d = Eigen::VectorXd::Zero(p.size());
    auto part = direction.d.segment(block.offset, block.size);
    part = p.segment(block.offset, block.size);
    if (block.kind == ParameterKind::kInitialVelocity) {
      for (double& value : part) value = uniform(random);
    } else if (part.isZero(0.0)) {
      part.setOnes();
    }
    directions.push_back(std::move(direction));
  }
  return directions;
}

// Fourth-order quotients at ever smaller steps, until two neighbours agree.
class Quotients {
 public:
  Quotients(const VectorFunction& f, const Eigen::VectorXd& p, const Direction& d,
            const Eigen::VectorXd& tangent, double rounding, bool is_long) {
    const std::vector<double> steps =
        is_long ? std::vector<double>{1e-4, 1e-5}
                : std::vector<double>{1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8};
    DerivativeCheck before;
    for (double s : steps) {
      const DerivativeCheck now = CheckDirectionalDerivative(f, p, d.d, tangent, {s});
      if (now.numeric.size() == 0) continue;
      zero &= now.norm == 0.0;
      if (s * std::max(now.norm, tangent.norm()) < kMeasurable * rounding) continue;
      if (before.numeric.size() > 0) Compare(before, now);
      before = now;
      if (noise < 1e-8 && error < 1e-6) break;
    }
  }

  double noise = std::numeric_limits<double>::infinity();
  double error = std::numeric_limits<double>::infinity();
  bool zero = true;  // no step saw any change

 private:
  void Compare(const DerivativeCheck& before, const DerivativeCheck& now) {
    const double size =
        std::max({before.norm, now.norm, std::numeric_limits<double>::min()});
    const double difference = (before.numeric - now.numeric).norm() / size;
    if (!(difference < noise)) return;
    noise = difference;
    error = std::min(before.relative_error, now.relative_error);
  }
};

// What the quotients from the two sides differ by at two small steps, relative to their
// mean; the less of both. Where a derivative exists the smaller step shows little of
// it.
double Kink(const VectorFunction& f, const Eigen::VectorXd& p, const Direction& d) {
  const Eigen::VectorXd middle = f(p);
  double kink = std::numeric_limits<double>::infinity();
  for (double s : {1e-4, 1e-6}) {
    const Eigen::VectorXd after = f(p + s * d.d), before = f(p - s * d.d);
    const double two_sided = (after - before).norm();
    if (!(two_sided > 0.0)) return 0.0;
    kink = std::min(kink, (after - 2.0 * middle + before).norm() / two_sided);
  }
  return kink;
}

std::string Text(const char* format, const std::string& name, double a, double b) {
  char buffer[200];
  std::snprintf(buffer, sizeof(buffer), format, name.c_str(), a, b);
  return buffer;
}

struct Verdict {
  GradientVerdict verdict = GradientVerdict::kRight;
  std::string why;
};

// @param kink  half of what one-sided quotients differ by; asked for if need be
Verdict Judge(const std::string& name, double identity, const Quotients& q,
              bool tangent_is_zero, const std::function<double()>& kink) {
  if (!(identity <= kWrongIdentity)) {
    return {GradientVerdict::kWrong,
            Text("%s: adjoint and tangent differ by %.2g (of %.2g allowed)", name,
                 identity, kIdentity)};
  }
  if (tangent_is_zero && q.zero) return {};
  if (!(q.noise <= kDecidableNoise)) {
    return {GradientVerdict::kUndecidable,
            std::isinf(q.noise)
                ? name + ": its influence is within the rounding of positions"
                : Text("%s: differences agree among themselves to %.1g only, and with "
                       "the tangent to %.1g",
                       name, q.noise, q.error)};
  }
  if (!(q.error <= std::max(kLeastTolerance, kNoiseMargin * q.noise))) {
    const double half = kink();
    if (q.error <= kKinkMargin * half) {
      return {GradientVerdict::kUndecidable,
              Text("%s: the motion passes a kink, whose two sides differ by %.2g; the "
                   "tangent is off their mean by %.2g",
                   name, 2.0 * half, q.error)};
    }
    return {GradientVerdict::kWrong,
            Text("%s: off differences by %.2g, whose noise is %.1g", name, q.error,
                 q.noise)};
  }
  if (!(identity <= kIdentity)) {
    return {GradientVerdict::kUndecidable,
            Text("%s: adjoint and tangent differ by %.1g (of %.1g allowed)", name,
                 identity, kIdentity)};
  }
  return {};
}

void Count(const Verdict& verdict, const Quotients& q, GradientCheck* check) {
  switch (verdict.verdict) {
    case GradientVerdict::kRight:
      ++check->right;
      break;
    case GradientVerdict::kUndecidable:
      ++check->undecidable;
      break;
    default:
      ++check->wrong;
  }
  if (verdict.verdict > check->verdict) {
    check->verdict = verdict.verdict;
    check->why = verdict.why;
  }
  if (std::isfinite(q.error) && q.error > check->error) {
    check->error = q.error;
    check->noise = q.noise;
  }
}

// States that are large though they hardly move round in proportion to their size.
double RoundingOf(const Eigen::MatrixXd& positions) {
  return std::numeric_limits<double>::epsilon() * positions.norm();
}

GradientCheck Refused(GradientVerdict verdict, const std::string& why) {
  GradientCheck check;
  check.verdict = verdict;
  check.why = why;
  check.wrong = verdict == GradientVerdict::kWrong;
  return check;
}

}  // namespace

std::string GradientVerdictName(GradientVerdict verdict) {
  switch (verdict) {
    case GradientVerdict::kRight:
      return "right";
    case GradientVerdict::kUndecidable:
      return "not decidable";
    case GradientVerdict::kWrong:
      return "wrong";
    case GradientVerdict::kRefused:
      return "refused";
  }
  return {};
}

Derivatives EngineDerivatives(Simulator* simulator, const Rollout& rollout,
                              const Eigen::MatrixXd& weights,
                              const std::vector<Eigen::VectorXd>& directions) {
  Sensitivity sensitivity(simulator, &rollout);
  Derivatives result;
  result.gradient = sensitivity.Gradient({weights});
  std::vector<Eigen::MatrixXd> dx, dv;
  for (const Eigen::VectorXd& d : directions) {
    sensitivity.JacobianVectorProduct(d, &dx, &dv);
    result.tangents.push_back(dx[0]);
  }
  if (!sensitivity.ok()) result.failure = sensitivity.status().Message();
  return result;
}

void EstimateForCheck(Scene* scene) {
  ClothObject& object = scene->objects[0];
  object.mass_mode = ParameterMode::kGlobal;
  if (!object.springs.empty()) object.stiffness_mode = ParameterMode::kGlobal;
  object.estimate_damping = object.damping > 0.0;
  object.estimate_drag = object.drag_coefficient > 0.0;
  scene->estimate_wind = object.drag_coefficient > 0.0;
  object.estimate_initial_velocity = true;
}

GradientCheck CheckGradient(const Scene& scene, int num_frames,
                            const DerivativeFunction& derivatives) {
  Simulator simulator(scene);
  const Eigen::VectorXd p = simulator.layout().Extract(scene);
  const std::vector<Direction> directions = Directions(simulator.layout(), p);
  std::vector<Eigen::VectorXd> vectors;
  for (const Direction& d : directions) vectors.push_back(d.d);
  const Rollout rollout = simulator.Run(p, num_frames);
  if (!rollout.status().ok()) {
    return Refused(GradientVerdict::kRefused, "the rollout fails");
  }
  const Eigen::MatrixXd& x = rollout.trajectory().positions[0];
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  const Eigen::MatrixXd weights =
      Eigen::MatrixXd::NullaryExpr(x.rows(), x.cols(), [&] { return uniform(random); });
  const Derivatives exact = derivatives(&simulator, rollout, weights, vectors);
  if (!exact.failure.empty()) {
    return Refused(GradientVerdict::kRefused, exact.failure);
  }
  const VectorFunction f = [&](const Eigen::VectorXd& q) -> Eigen::VectorXd {
    const Rollout moved = simulator.Run(q, num_frames);
    return moved.trajectory().positions[0].reshaped();
  };
  GradientCheck check;
  for (size_t k = 0; k < directions.size(); ++k) {
    const Eigen::MatrixXd& dx = exact.tangents[k];
    const double backward = exact.gradient.dot(vectors[k]);
    const double forward = weights.cwiseProduct(dx).sum();
    // Zero only where the parameter has no influence at all.
    const double size = std::max(dx.norm(), std::numeric_limits<double>::min());
    const double identity = std::abs(backward - forward) / size;
    const Quotients quotients(f, p, directions[k], dx.reshaped(), RoundingOf(x),
                              num_frames > kLongRollout);
    const auto kink = [&] { return Kink(f, p, directions[k]); };
    Count(Judge(directions[k].name, identity, quotients, dx.isZero(0.0), kink),
          quotients, &check);
    check.identity = std::max(check.identity, identity);
  }
  return check;
}

}  // namespace dpe::experiments
