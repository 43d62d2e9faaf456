// How many stiffnesses the data require: one per object (G), one per group of springs
// (R), or one per spring (L).
//
// The last third of the frames is held out. For each object in turn, in the order of
// the scene, the fits G, R and L to the frames before are simulated on over the held
// out ones; a richer one is kept in place of the best so far only if its forecast is
// better by more than noise explains (forecast_weight.h has the equations). The chosen
// one is then fitted to all frames. Objects in turn: nothing but an estimated wind
// couples them, so that what one needs says nothing about another.
//
// Held-out frames rather than an information criterion: BIC counts parameters whether
// or not the data determine them, needs the noise or a model of it, and trusts that the
// optimiser has found the least cost. A forecast needs none of this, and it is what a
// fitted cloth is for.
//
// What it cannot do:
// - see what the held-out frames do not show: a motion that has come to rest by then
//   asks for no more than its resting shape does;
// - say that the chosen model is right: of models that are all wrong it takes the one
//   with the best forecast;
// - find a richer truth that the data are too few or too noisy to determine: a forecast
//   is the worse for badly determined parameters, so the simpler model is kept;
// - tell when mass, damping, drag or wind are to be estimated: these stay as the caller
//   says in all candidates. Where mass is estimated and no known force fixes the scale,
//   its total is kept, as in every fit.
#ifndef DPE_ESTIMATION_MODEL_SELECTION_H_
#define DPE_ESTIMATION_MODEL_SELECTION_H_

#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "dpe/engine/scene.h"
#include "dpe/estimation/estimator.h"
#include "dpe/estimation/export.h"
#include "dpe/estimation/observations.h"

namespace dpe {

// Applies settings of which some are left to be chosen: "auto" for all objects, or per
// object "auto" in place of its two letters ("auto,nn"). Where one is to be chosen, the
// mass is estimated as the scene says, the stiffness as G for the time being. "auto"
// for all means the objects of which the scene estimates mass or stiffness; all if
// there are none.
//
// @return  the objects whose settings are to be chosen; empty: the settings were
//          letters, and were applied as ApplySettings does
// @throws SceneError naming what is accepted
DPE_ESTIMATION_API std::vector<int> ApplyAutoSettings(const std::string& settings,
                                                      Scene* scene);

// A fit that is about to begin.
struct ModelFit {
  std::string settings;
  int num_parameters = 0;
  int num_frames = 0;
  bool is_final = false;  // of the chosen one, to all frames
};

struct ModelSelectionOptions {
  std::vector<int> objects;  // whose stiffness mode is chosen
  double held_out_fraction = 1.0 / 3.0;
  std::function<void(const ModelFit&)> started;
};

// One row of the table.
struct ModelCandidate {
  std::string settings;
  int num_parameters = 0;
  bool was_fitted = false;  // what follows says nothing if not
  Termination termination = Termination::kNumericalFailure;
  int iterations = 0;
  double seconds = 0.0;
  // m; NaN if it could not be simulated
  double fit_rms = std::numeric_limits<double>::quiet_NaN();
  double held_out_rms = std::numeric_limits<double>::quiet_NaN();
  // Compared with the best so far, whose settings these are.
  std::string compared_with;
  double weight = std::numeric_limits<double>::quiet_NaN();
  double weight_deviation = std::numeric_limits<double>::quiet_NaN();
  bool kept = false;
  std::string reason;  // for which it was kept or not
};

struct ModelSelection {
  std::string criterion;      // in words
  int num_frames = 0;         // of the longest capture
  int num_fitted_frames = 0;  // by the candidates; the others were held out
  std::vector<ModelCandidate> candidates;
  std::string chosen;  // settings
  std::string reason;  // one sentence
};

struct SelectedModel {
  ModelSelection selection;
  // Of the chosen model's fit to all frames; wall_time_s includes the candidates' fits.
  // Where time ran out before it, of its fit as a candidate (num_frames and a note say
  // so); where not even the first candidate could be fitted, of that attempt.
  EstimatorSummary summary;
};

// Chooses the stiffness mode of `selection.objects` and fits, to one capture or to
// several of one cloth (of each of which a third is held out).
//
// A candidate is started from the best so far, or from where `options` say if the
// motion is closer to the target there (InitMethod::kAuto: by inverse dynamics only,
// never the scene's values). max_seconds is for everything: a candidate may take half
// of what is left.
//
// @throws SceneError as Estimate, if there are too few frames, nothing is observed in
//         the held-out ones, or a checkpoint is asked for
DPE_ESTIMATION_API SelectedModel SelectModel(const Scene& scene,
                                             const Observations& observations,
                                             const EstimatorOptions& options,
                                             const ModelSelectionOptions& selection);
DPE_ESTIMATION_API SelectedModel
SelectModel(const std::vector<CapturedMotion>& captures,
            const EstimatorOptions& options, const ModelSelectionOptions& selection);

}  // namespace dpe

#endif  // DPE_ESTIMATION_MODEL_SELECTION_H_
