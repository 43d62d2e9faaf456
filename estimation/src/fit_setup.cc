#include "fit_setup.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "dpe/engine/parameters.h"
#include "frame_interpolation.h"

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

Observations FirstFrames(const Observations& observations, int num_frames) {
  Observations first = observations;
  const auto cut = [num_frames](std::vector<Eigen::MatrixXd>* matrices) {
    for (Eigen::MatrixXd& m : *matrices) {
      if (m.cols() > num_frames) m.conservativeResize(Eigen::NoChange, num_frames);
    }
  };
  cut(&first.positions);
  cut(&first.sigmas);
  const auto is_late = [num_frames](const MarkerSample& sample) {
    return !IsWithinFrames(sample.time, num_frames);
  };
  first.samples.erase(
      std::remove_if(first.samples.begin(), first.samples.end(), is_late),
      first.samples.end());
  return first;
}

namespace {

// Calls `see` with the noise of every observation of an estimated object.
template <typename See>
void ForEachSigma(const Scene& scene, const Observations& observations, See see) {
  const std::vector<char> is_estimated = ParameterLayout::EstimatedObjects(scene);
  for (int object = 0; object < static_cast<int>(observations.positions.size());
       ++object) {
    if (is_estimated[object] == 0) continue;
    for (int f = 0; f < observations.positions[object].cols(); ++f) {
      for (int v = 0; v < scene.objects[object].num_vertices(); ++v) {
        if (observations.IsObserved(object, v, f)) {
          see(observations.Sigma(object, v, f));
        }
      }
    }
  }
  for (const MarkerSample& sample : observations.samples) {
    see(observations.Sigma(sample));
  }
}

}  // namespace

bool NoiseIsKnown(const Scene& scene, const Observations& observations) {
  bool is_known = false;
  ForEachSigma(scene, observations, [&](double sigma) { is_known |= sigma > 0.0; });
  return is_known;
}

double CostOfRms(const Scene& scene, const Observations& observations, double rms) {
  double sum = 0.0;  // of squared weights
  ForEachSigma(scene, observations,
               [&](double sigma) { sum += sigma > 0.0 ? 1.0 / (sigma * sigma) : 1.0; });
  return 0.5 * rms * rms * sum;
}

}  // namespace dpe
