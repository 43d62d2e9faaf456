#include "fit_setup.h"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "dpe/engine/parameters.h"
#include "dpe/engine/scene_io.h"
#include "dpe/estimation/joint_layout.h"
#include "frame_interpolation.h"
#include "moved_observations.h"

namespace dpe {

Scene WithoutEstimatedValues(const Scene& scene) {
  const ParameterLayout layout(scene);
  Eigen::VectorXd neutral = Eigen::VectorXd::Zero(layout.size());
  for (const ParameterBlock& block : layout.blocks()) {
    if (block.kind == ParameterKind::kInitialPosition) {
      // There is no neutral shape: where the motion starts to be looked for.
      neutral.segment(block.offset, block.size) =
          layout.Extract(scene).segment(block.offset, block.size);
    }
    if (!ParameterKindIsPositive(block.kind)) continue;
    neutral.segment(block.offset, block.size).setOnes();
  }
  Scene blank = scene;
  layout.Insert(neutral, &blank);
  return blank;
}

int NumFramesToFit(const Scene& scene, const Observations& observations,
                   int asked_for) {
  if (ParameterLayout(scene).size() == 0) {
    throw SceneError(
        "nothing is estimated: set the scene's optimizationSettings or --settings "
        "(mass and stiffness: n, G, L or R per object) or its `estimate` object");
  }
  if (observations.positions.size() > scene.objects.size()) {
    throw SceneError("the observations hold " +
                     std::to_string(observations.positions.size()) +
                     " objects, the scene " + std::to_string(scene.objects.size()));
  }
  const int observed = observations.num_frames();
  if (asked_for > observed) {
    throw SceneError("frames to fit: " + std::to_string(asked_for) + " asked for, " +
                     std::to_string(observed) + " observed");
  }
  const int frames = asked_for > 0 ? asked_for : observed;
  if (frames < 2) {
    throw SceneError("frames to fit: " + std::to_string(frames) +
                     "; accepted are 2 or more (frame 0 is the initial state)");
  }
  return frames;
}

namespace {

void RequireOneCloth(const std::vector<CaptureView>& captures) {
  std::vector<const Scene*> scenes;
  std::vector<std::string> names;
  for (const CaptureView& capture : captures) {
    ValidateScene(*capture.scene, capture.name);
    scenes.push_back(capture.scene);
    names.push_back(capture.name);
  }
  RequireSameCloths(scenes, names);
}

int FramesOf(const CaptureView& capture, int asked_for) {
  try {
    return NumFramesToFit(*capture.scene, *capture.observations, asked_for);
  } catch (const SceneError& error) {
    throw SceneError(capture.name + ": " + error.what());
  }
}

// A capture that shows nothing, or whose residuals have another unit than the others',
// is a mistake that the fit as a whole would hide.
void RequireAlikeObservations(const std::vector<CaptureView>& given,
                              const std::vector<FitCapture>& captures) {
  const auto noise_is_known = [&](size_t c) {
    return NoiseIsKnown(captures[c].blank, captures[c].observations);
  };
  for (size_t c = 0; c < captures.size(); ++c) {
    const FitCapture& capture = captures[c];
    if (FirstMovedFrame(capture.blank, capture.observations, capture.num_frames) ==
        capture.num_frames) {
      throw SceneError(given[c].name +
                       ": no free vertex of an estimated object is observed after "
                       "frame 0");
    }
    if (noise_is_known(c) == noise_is_known(0)) continue;
    throw SceneError("the noise (sigma) of " + given[noise_is_known(c) ? c : 0].name +
                     " is known and that of " + given[noise_is_known(c) ? 0 : c].name +
                     " is not; accepted are all or none (a common sigma fills what is "
                     "missing)");
  }
}

}  // namespace

std::vector<FitCapture> PrepareCaptures(const std::vector<CaptureView>& captures,
                                        int asked_for) {
  const bool are_several = captures.size() > 1;
  if (captures.empty()) throw SceneError("a fit needs at least one capture");
  if (are_several) RequireOneCloth(captures);
  int most = 0;
  for (const CaptureView& capture : captures) {
    most = std::max(most, capture.observations->num_frames());
  }
  std::vector<FitCapture> prepared;
  for (const CaptureView& capture : captures) {
    FitCapture fit;
    // Asking for more than any has is a mistake, for more than this one has is not.
    const int frames = asked_for > most
                           ? asked_for
                           : std::min(asked_for, capture.observations->num_frames());
    fit.num_frames =
        are_several ? FramesOf(capture, frames)
                    : NumFramesToFit(*capture.scene, *capture.observations, asked_for);
    fit.blank = WithoutEstimatedValues(*capture.scene);
    fit.observations = CutFrames(*capture.observations, 0, fit.num_frames);
    prepared.push_back(std::move(fit));
  }
  if (are_several) RequireAlikeObservations(captures, prepared);
  return prepared;
}

std::vector<FitCapture> CutCaptures(const std::vector<FitCapture>& captures,
                                    int num_frames) {
  std::vector<FitCapture> cut;
  for (const FitCapture& capture : captures) {
    FitCapture shorter;
    shorter.blank = capture.blank;
    shorter.num_frames = std::min(capture.num_frames, num_frames);
    shorter.observations = CutFrames(capture.observations, 0, shorter.num_frames);
    cut.push_back(std::move(shorter));
  }
  return cut;
}

std::vector<const Scene*> ScenesOf(const std::vector<FitCapture>& captures) {
  std::vector<const Scene*> scenes;
  for (const FitCapture& capture : captures) scenes.push_back(&capture.blank);
  return scenes;
}

int MostFrames(const std::vector<FitCapture>& captures) {
  int most = 0;
  for (const FitCapture& capture : captures) most = std::max(most, capture.num_frames);
  return most;
}

Observations CutFrames(const Observations& observations, int first, int num_frames) {
  Observations cut;
  cut.markers = observations.markers;
  cut.sigma = observations.sigma;
  const auto columns = [&](const std::vector<Eigen::MatrixXd>& all,
                           std::vector<Eigen::MatrixXd>* some) {
    for (const Eigen::MatrixXd& matrix : all) {
      const int available = static_cast<int>(matrix.cols()) - first;
      some->emplace_back();
      if (available <= 0) continue;
      some->back() = matrix.middleCols(first, std::min(num_frames, available));
    }
  };
  columns(observations.positions, &cut.positions);
  columns(observations.sigmas, &cut.sigmas);
  for (MarkerSample sample : observations.samples) {
    sample.time -= first;
    if (sample.time < 0.0 || !IsWithinFrames(sample.time, num_frames)) continue;
    cut.samples.push_back(sample);
  }
  return cut;
}

bool NoiseIsKnown(const Scene& scene, const Observations& observations) {
  bool is_known = false;
  ForEachObservation(scene, observations, observations.num_frames(),
                     [&](double /*time*/, double sigma, bool is_moved) {
                       is_known |= is_moved && sigma > 0.0;
                     });
  return is_known;
}

double CostOfRms(const Scene& scene, const Observations& observations, double rms) {
  double sum = 0.0;  // of squared weights
  ForEachObservation(scene, observations, observations.num_frames(),
                     [&](double /*time*/, double sigma, bool /*is_moved*/) {
                       sum += sigma > 0.0 ? 1.0 / (sigma * sigma) : 1.0;
                     });
  return 0.5 * rms * rms * sum;
}

}  // namespace dpe
