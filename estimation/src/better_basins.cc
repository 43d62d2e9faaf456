#include "better_basins.h"

#include <sstream>
#include <string>

#include "profile_scan.h"
#include "starting_point.h"

namespace dpe {
namespace {

// How often a fit is repeated, at most, each way.
constexpr int kMaxRounds = 3;

class Searcher {
 public:
  explicit Searcher(const BasinSearch& search)
      : search_(search), evaluator_(search.fit->evaluator()) {}

  void Run() {
    for (int round = 0; round < kMaxRounds && CanBeBetter(); ++round) {
      if (!FromTrialValues()) break;
    }
    if (!search_.along_valleys) return;
    for (int round = 0; round < kMaxRounds && CanBeBetter(); ++round) {
      if (!FromProfiles()) break;
    }
  }

 private:
  bool CanBeBetter() {
    cost_ = evaluator_->best_cost();
    rms_ = search_.fit->best_rms();
    return search_.summary->usable() && !search_.fit->IsAtRounding() &&
           !search_.stop->Poll();
  }

  bool FromTrialValues() {
    const Eigen::VectorXd better = FindBetterTrialPoint(search_.stop, evaluator_);
    return better.size() > 0 &&
           From(better, "log-spaced trial values showed a better basin");
  }

  // From the lowest few minima that the profiles have, until one leads lower.
  bool FromProfiles() {
    int num_tried = 0;
    for (const Eigen::VectorXd& minimum : ProfileMinima(search_.stop, evaluator_)) {
      if (num_tried++ == kMaxRounds || search_.stop->Poll()) return false;
      if (From(minimum, "along the valley that it lies in there is a lower minimum")) {
        return true;
      }
    }
    return false;
  }

  // True if the cost is now lower than where the fit had converged; else all is as it
  // was.
  bool From(const Eigen::VectorXd& coordinates, const std::string& reason) {
    EstimatorSummary* summary = search_.summary;
    const Termination termination = summary->termination;
    const std::string message = summary->message;
    search_.fit->problem()->set_coordinates(coordinates);
    if (evaluator_->Evaluate(coordinates)) search_.minimise();
    if (evaluator_->best_cost() < (1.0 - kBetter) * cost_) {
      std::ostringstream note;
      note << "the fit had converged to RMS " << rms_ << " m; " << reason
           << ", from which it was repeated";
      summary->notes.push_back(note.str());
      return true;
    }
    search_.fit->problem()->set_coordinates(evaluator_->best_coordinates());
    if (!search_.stop->stopped()) {
      summary->termination = termination;
      summary->message = message;
    }
    return false;
  }

  const BasinSearch& search_;
  TrajectoryEvaluator* evaluator_;
  double cost_ = 0.0, rms_ = 0.0;  // where the fit had converged
};

}  // namespace

void SearchBetterBasins(const BasinSearch& search) { Searcher(search).Run(); }

}  // namespace dpe
