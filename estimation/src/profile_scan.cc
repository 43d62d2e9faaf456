#include "profile_scan.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace dpe {
namespace {

constexpr int kPerDecade = 6;
constexpr int kSteps = 9;         // each way
constexpr double kHighest = 4.0;  // times the best point's cost
constexpr int kCorrections = 3;
// A correction that gains less than this fraction was the last.
constexpr double kSmallGain = 1e-3;
// Added to J_o^T J_o's diagonal, relative to it, for directions that cost nothing.
constexpr double kDamping = 1e-9;

struct ProfilePoint {
  Eigen::VectorXd coordinates;
  double cost = 0.0;
};

class Profile {
 public:
  Profile(int held, StopControl* stop, TrajectoryEvaluator* evaluator)
      : held_(held), stop_(stop), evaluator_(evaluator) {}

  // The minima on the way from `start` in direction +1 or -1.
  void Follow(const Eigen::VectorXd& start, int direction,
              std::vector<ProfilePoint>* minima) {
    if (!evaluator_->Evaluate(start)) return;
    std::vector<ProfilePoint> path = {{start, evaluator_->cost()}};
    const double limit = kHighest * path[0].cost;
    const double step = direction * std::log(10.0) / kPerDecade;
    while (path.size() <= kSteps && !stop_->Poll()) {
      ProfilePoint next;
      if (!StepAlong(path.back().coordinates, step, &next) || next.cost > limit) break;
      path.push_back(next);
      // Falling at the end is as good as a minimum: there is one further on.
      const size_t n = path.size();
      if (n >= 3 && IsMinimum(path, n - 2)) minima->push_back(path[n - 2]);
    }
    const size_t n = path.size();
    if (n >= 2 && path[n - 1].cost < path[n - 2].cost) minima->push_back(path[n - 1]);
  }

 private:
  static bool IsMinimum(const std::vector<ProfilePoint>& path, size_t k) {
    return k > 0 && path[k].cost < path[k - 1].cost && path[k].cost <= path[k + 1].cost;
  }

  bool StepAlong(const Eigen::VectorXd& from, double step, ProfilePoint* point) {
    Eigen::VectorXd trial = from;
    trial[held_] += step;
    Eigen::VectorXd slope;
    if (evaluator_->Evaluate(from) && Others(/*of_residuals=*/false, &slope)) {
      Eigen::VectorXd predicted = from + step * slope;
      predicted[held_] = trial[held_];
      if (evaluator_->Evaluate(predicted)) trial = predicted;
    }
    if (!evaluator_->Evaluate(trial)) return false;
    *point = {trial, evaluator_->cost()};
    for (int i = 0; i < kCorrections && !stop_->Poll(); ++i) {
      Eigen::VectorXd correction;
      if (!evaluator_->Evaluate(point->coordinates) ||
          !Others(/*of_residuals=*/true, &correction)) {
        break;
      }
      const double before = point->cost;
      if (!Correct(correction, point) || point->cost > (1.0 - kSmallGain) * before) {
        break;
      }
    }
    return true;
  }

  // Takes the correction or a part of it, if that lowers the cost.
  bool Correct(const Eigen::VectorXd& correction, ProfilePoint* point) {
    for (const double part : {1.0, 0.25}) {
      const Eigen::VectorXd trial = point->coordinates + part * correction;
      if (!evaluator_->Evaluate(trial) || evaluator_->cost() >= point->cost) continue;
      *point = {trial, evaluator_->cost()};
      return true;
    }
    return false;
  }

  // -(J_o^T J_o)^-1 J_o^T b at the evaluator's point, 0 for the one that is held.
  // @param of_residuals  b is r, else J_i
  bool Others(bool of_residuals, Eigen::VectorXd* result) {
    const int size = evaluator_->num_parameters();
    result->setZero(size);
    if (size == 1) return !of_residuals;
    if (!evaluator_->EvaluateJacobian()) return false;
    const RowMajorMatrix jacobian = evaluator_->DenseJacobian();
    Eigen::MatrixXd normal = jacobian.transpose() * jacobian;
    Eigen::VectorXd right =
        of_residuals ? Eigen::VectorXd(jacobian.transpose() * evaluator_->residuals())
                     : Eigen::VectorXd(normal.col(held_));
    normal.diagonal() *= 1.0 + kDamping;
    normal.row(held_).setZero();
    normal.col(held_).setZero();
    normal(held_, held_) = 1.0;
    right[held_] = 0.0;
    *result = -normal.ldlt().solve(right);
    return result->allFinite();
  }

  int held_;
  StopControl* stop_;
  TrajectoryEvaluator* evaluator_;
};

}  // namespace

std::vector<Eigen::VectorXd> ProfileMinima(StopControl* stop,
                                           TrajectoryEvaluator* evaluator) {
  const Eigen::VectorXd best = evaluator->best_coordinates();
  std::vector<ProfilePoint> minima;
  for (int i = 0; i < best.size(); ++i) {
    if (!evaluator->map().is_log(i)) continue;
    Profile profile(i, stop, evaluator);
    for (const int direction : {-1, 1}) profile.Follow(best, direction, &minima);
  }
  std::sort(
      minima.begin(), minima.end(),
      [](const ProfilePoint& a, const ProfilePoint& b) { return a.cost < b.cost; });
  std::vector<Eigen::VectorXd> coordinates;
  for (const ProfilePoint& minimum : minima) {
    coordinates.push_back(minimum.coordinates);
  }
  return coordinates;
}

}  // namespace dpe
