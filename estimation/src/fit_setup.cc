#include "fit_setup.h"

#include <algorithm>
#include <string>
#include <vector>

#include "dpe/engine/parameters.h"
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
