#include "fit_setup.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "dpe/engine/parameters.h"

namespace dpe {
namespace {

// Observations of what no parameter moves: fixed vertices and frame 0.
Observations WithoutFreeVertices(const Scene& scene, Observations observations) {
  for (size_t object = 0; object < observations.positions.size(); ++object) {
    Eigen::MatrixXd& positions = observations.positions[object];
    if (positions.size() == 0) continue;
    for (int v = 0; v < positions.rows() / 3; ++v) {
      if (scene.objects[object].is_fixed[v]) continue;
      positions.block(3 * v, 1, 3, positions.cols() - 1)
          .setConstant(std::numeric_limits<double>::quiet_NaN());
    }
  }
  return observations;
}

// The initial state, held, with fixed vertices on their paths.
Eigen::MatrixXd PrescribedPositions(const ClothObject& cloth, int num_frames) {
  Eigen::MatrixXd positions = cloth.positions.replicate(1, num_frames);
  for (const PrescribedPath& path : cloth.prescribed_paths) {
    const int last = static_cast<int>(path.positions.cols()) - 1;
    for (int f = 0; f < num_frames; ++f) {
      positions.col(f).segment<3>(3 * path.vertex) =
          path.positions.col(std::min(f, last));
    }
  }
  return positions;
}

}  // namespace

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
    return sample.time > num_frames - 1;
  };
  first.samples.erase(
      std::remove_if(first.samples.begin(), first.samples.end(), is_late),
      first.samples.end());
  return first;
}

RmsScale::RmsScale(const Simulator& simulator, const Observations& observations) {
  const Scene& scene = simulator.scene();
  const int num_frames = observations.num_frames();
  const Observations unmoved = WithoutFreeVertices(scene, observations);
  Trajectory prescribed;
  long num_unmoved = 0;
  for (int object = 0; object < static_cast<int>(scene.objects.size()); ++object) {
    prescribed.positions.emplace_back();
    if (!simulator.is_simulated(object)) continue;
    num_positions_ += static_cast<double>(observations.NumObserved(object));
    num_unmoved += unmoved.NumObserved(object);
    prescribed.positions.back() =
        PrescribedPositions(scene.objects[object], num_frames);
  }
  if (num_unmoved == 0) return;
  const double rms = RmsPositionError(prescribed, unmoved, num_frames);
  constant_square_sum_ = rms * rms * static_cast<double>(num_unmoved);
}

double RmsScale::Rms(double cost) const {
  return std::sqrt((2.0 * cost + constant_square_sum_) / num_positions_);
}

}  // namespace dpe
