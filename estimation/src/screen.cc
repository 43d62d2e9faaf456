#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include "starting_point.h"

namespace dpe {
namespace {

// Trial values span these powers of ten in SI units.
constexpr double kMinExponent = -4.0;
constexpr double kMaxExponent = 4.0;

// Frames of the first, cheap look, and how many of its best are looked at in full.
constexpr int kShortHorizon = 10;
constexpr int kNumFinalists = 8;

constexpr int kSweeps = 3;  // of the coordinate-wise search

struct Trial {
  Eigen::VectorXd coordinates;
  double cost = 0.0;
};

std::vector<double> LogSpaced(int per_decade) {
  std::vector<double> values;
  const int count =
      static_cast<int>(std::lround((kMaxExponent - kMinExponent) * per_decade));
  for (int i = 0; i <= count; ++i) {
    values.push_back(std::log(10.0) *
                     (kMinExponent + static_cast<double>(i) / per_decade));
  }
  return values;
}

// Of the longest segment.
int MostFrames(const TrajectoryEvaluator& evaluator) {
  int most = 0;
  for (int s = 0; s < evaluator.num_segments(); ++s) {
    most = std::max(most, evaluator.num_frames(s));
  }
  return most;
}

class Screen {
 public:
  Screen(StopControl* stop, TrajectoryEvaluator* evaluator)
      : stop_(stop),
        evaluator_(evaluator),
        num_frames_(MostFrames(*evaluator)),
        horizon_(std::min(num_frames_, kShortHorizon)) {
    for (const ParameterBlock& block : evaluator->layout().blocks()) {
      if (ParameterKindIsPositive(block.kind)) blocks_.push_back(&block);
    }
  }

  StartingPoint Run() {
    TryAll();
    StartingPoint start;
    start.init = "screen";
    std::sort(trials_.begin(), trials_.end(),
              [](const Trial& a, const Trial& b) { return a.cost < b.cost; });
    double best = std::numeric_limits<double>::infinity();
    int finalists = 0;
    for (const Trial& trial : trials_) {
      if (finalists == kNumFinalists || stop_->Poll()) break;
      double cost = 0.0;
      if (!evaluator_->CostOverHorizon(trial.coordinates, num_frames_, &cost)) {
        continue;
      }
      ++finalists;
      if (cost >= best) continue;
      best = cost;
      start.coordinates = trial.coordinates;
      start.ok = true;
    }
    start.message = "none of " + std::to_string(num_tried_) +
                    " trial values between 1e-4 and 1e4 could be simulated";
    if (start.ok) {
      start.notes.push_back("screen: best of " + std::to_string(num_tried_) +
                            " trial points, " +
                            std::to_string(num_tried_ - trials_.size()) +
                            " of which could not be simulated");
    }
    return start;
  }

 private:
  // Every combination for one or two blocks, else one block at a time.
  void TryAll() {
    Eigen::VectorXd point = Eigen::VectorXd::Zero(evaluator_->num_parameters());
    if (blocks_.size() <= 1) {
      Scan(0, 4, &point);
    } else if (blocks_.size() == 2) {
      for (const double value : LogSpaced(2)) {
        SetBlock(1, value, &point);
        Eigen::VectorXd scanned = point;
        Scan(0, 2, &scanned);
      }
    } else {
      for (int sweep = 0; sweep < kSweeps; ++sweep) {
        for (size_t b = 0; b < blocks_.size(); ++b) Scan(b, 2, &point);
      }
    }
  }

  void SetBlock(size_t b, double value, Eigen::VectorXd* point) const {
    if (b >= blocks_.size()) return;
    point->segment(blocks_[b]->offset, blocks_[b]->size).setConstant(value);
  }

  // Tries all values of one block; `point` is left at the best.
  void Scan(size_t b, int per_decade, Eigen::VectorXd* point) {
    double best = std::numeric_limits<double>::infinity();
    Eigen::VectorXd best_point = *point;
    for (const double value : LogSpaced(per_decade)) {
      if (stop_->Poll()) break;
      Trial trial;
      trial.coordinates = *point;
      SetBlock(b, value, &trial.coordinates);
      ++num_tried_;
      if (!evaluator_->CostOverHorizon(trial.coordinates, horizon_, &trial.cost)) {
        continue;
      }
      if (trial.cost < best) {
        best = trial.cost;
        best_point = trial.coordinates;
      }
      trials_.push_back(std::move(trial));
    }
    *point = best_point;
  }

  StopControl* stop_;
  TrajectoryEvaluator* evaluator_;
  int num_frames_;
  int horizon_;
  std::vector<const ParameterBlock*> blocks_;
  std::vector<Trial> trials_;
  int num_tried_ = 0;
};

}  // namespace

Eigen::VectorXd FindBetterTrialPoint(StopControl* stop,
                                     TrajectoryEvaluator* evaluator) {
  const Eigen::VectorXd found = evaluator->best_coordinates();
  const int num_frames = MostFrames(*evaluator);
  double best = (1.0 - kBetter) * evaluator->best_cost();
  Eigen::VectorXd better;
  for (int i = 0; i < found.size(); ++i) {
    if (!evaluator->map().is_log(i)) continue;
    for (const double value : LogSpaced(found.size() == 1 ? 4 : 2)) {
      if (stop->Poll()) return better;
      Eigen::VectorXd trial = found;
      trial[i] = value;
      // Costs are sums over frames: the first frames alone rule most trials out.
      double cost = 0.0;
      if (!evaluator->CostOverHorizon(trial, kShortHorizon, &cost) || cost >= best ||
          !evaluator->CostOverHorizon(trial, num_frames, &cost) || cost >= best) {
        continue;
      }
      best = cost;
      better = trial;
    }
  }
  return better;
}

StartingPoint ScreenStartingPoints(StopControl* stop, TrajectoryEvaluator* evaluator) {
  return Screen(stop, evaluator).Run();
}

}  // namespace dpe
