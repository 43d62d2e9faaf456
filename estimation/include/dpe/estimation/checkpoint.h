// How far a fit has got, in a file from which it can be continued.
//
// The file is JSON, written to a temporary name, flushed to the disk and renamed, so
// that whatever ends the program leaves the old file or the new one, whole. It holds
// the point of least cost with all its digits, where the optimiser stood, and what the
// fit was of: continuing a fit of something else is an error that says what differs.
#ifndef DPE_ESTIMATION_CHECKPOINT_H_
#define DPE_ESTIMATION_CHECKPOINT_H_

#include <Eigen/Core>
#include <string>
#include <utility>
#include <vector>

#include "dpe/estimation/estimator.h"
#include "dpe/estimation/export.h"

namespace dpe {

// What a fit is of: (name, value) of everything that the result depends on, with
// digests in place of what is long.
using Fingerprint = std::vector<std::pair<std::string, std::string>>;

struct Checkpoint {
  // Of the file; one with another version is refused.
  static constexpr int kVersion = 1;

  Fingerprint problem;
  // "start": no iteration yet; "grow": in a horizon shorter than all frames; "fit": in
  // the fit to all of them, or the repetitions from better trial points after it.
  std::string stage;
  std::string init;  // the method that gave the start
  std::vector<std::string> notes;
  int num_frames = 0;                  // of the horizon that was being fitted
  std::vector<HorizonStage> horizons;  // of stage "grow", the last one is not finished
  int iterations = 0;
  int first_iteration = 0;  // of the horizon
  double radius = 0.0;      // of the trust region; 0: none yet, or the solver has none
  double seconds = 0.0;     // spent so far
  // NaN where the start could not be simulated over all frames.
  double initial_cost = 0.0;
  double initial_rms = 0.0;  // m
  double cost = 0.0;
  Eigen::VectorXd start;        // of ParameterMap: where the fit started
  Eigen::VectorXd coordinates;  // the point of least cost on this horizon
};

DPE_ESTIMATION_API std::string CheckpointToJson(const Checkpoint& checkpoint);

// @param text  what CheckpointToJson returned
// @param name  stands for the file in messages
// @throws SceneError if the text is not a whole checkpoint of this version
DPE_ESTIMATION_API Checkpoint ParseCheckpoint(const std::string& text,
                                              const std::string& name);

// @throws SceneError as ParseCheckpoint, and if the file cannot be read
DPE_ESTIMATION_API Checkpoint ReadCheckpoint(const std::string& path);

// @throws SceneError if the file cannot be written; the old one is then unchanged
DPE_ESTIMATION_API void WriteCheckpoint(const Checkpoint& checkpoint,
                                        const std::string& path);

// @param checkpoint  to continue from
// @param problem     of the fit that is about to begin
// @param name        stands for the file in messages
// @throws SceneError naming everything in which the problems differ
DPE_ESTIMATION_API void RequireSameProblem(const Checkpoint& checkpoint,
                                           const Fingerprint& problem,
                                           const std::string& name);

}  // namespace dpe

#endif  // DPE_ESTIMATION_CHECKPOINT_H_
