// The checkpoint files of one fit: the one it continues, and the one it writes.
#ifndef DPE_ESTIMATION_FIT_CHECKPOINTS_H_
#define DPE_ESTIMATION_FIT_CHECKPOINTS_H_

#include <optional>
#include <string>
#include <vector>

#include "dpe/estimation/checkpoint.h"
#include "dpe/estimation/estimator.h"
#include "fit_setup.h"
#include "optimizers.h"

namespace dpe {

class FitCheckpoints {
 public:
  // Reads the checkpoint to continue, if there is one.
  // @throws SceneError if it cannot be read or is of another fit, or there is no folder
  //         for the one to write
  FitCheckpoints(const std::vector<CaptureView>& captures,
                 const EstimatorOptions& options);

  // What to continue; null: nothing.
  const Checkpoint* resumed() const { return resumed_ ? &*resumed_ : nullptr; }

  // @throws SceneError if the checkpoint to continue has another number of coordinates,
  //         or one that is not finite
  void RequireCoordinates(int num_parameters) const;

  bool are_wanted() const { return !path_.empty(); }

  // Writes where the fit stands. A file that cannot be written, a disk that is
  // full say, is no reason to give up the fit: problem() says so in the end.
  //
  // @param context  of the optimiser at work, or to be at work next
  // @param radius   of the trust region; 0: none
  // @param start    where the fit started, coordinates
  void Save(const std::string& stage, const OptimizerContext& context, double radius,
            const Eigen::VectorXd& start, const EstimatorSummary& summary);

  // What went wrong when the last checkpoint was written; empty: nothing.
  const std::string& problem() const { return problem_; }

 private:
  std::string path_, resume_path_;
  Fingerprint fingerprint_;
  std::optional<Checkpoint> resumed_;
  std::string problem_;
};

}  // namespace dpe

#endif  // DPE_ESTIMATION_FIT_CHECKPOINTS_H_
