#include "state_guess.h"

#include <algorithm>
#include <vector>

namespace dpe {
namespace {

using Points = Eigen::Matrix3Xd;

struct Anchors {
  std::vector<int> vertices;
  Points values;
};

// Moves `base` by what the anchors say.
Points Interpolate(const Points& initial, const Points& base, const Anchors& anchors) {
  Points result = base;
  const int count = static_cast<int>(anchors.vertices.size());
  if (count == 0) return result;
  std::vector<char> is_anchor(base.cols(), 0);
  for (int k = 0; k < count; ++k) {
    result.col(anchors.vertices[k]) = anchors.values.col(k);
    is_anchor[anchors.vertices[k]] = 1;
  }
  for (int j = 0; j < base.cols(); ++j) {
    if (is_anchor[j]) continue;
    double sum = 0.0;
    Eigen::Vector3d offset = Eigen::Vector3d::Zero();
    for (int k = 0; k < count; ++k) {
      const int i = anchors.vertices[k];
      const double weight = 1.0 / (initial.col(i) - initial.col(j)).squaredNorm();
      sum += weight;
      offset += weight * (anchors.values.col(k) - base.col(i));
    }
    result.col(j) += offset / sum;
  }
  return result;
}

double SquaredDistance(const Points& base, const Anchors& anchors) {
  double sum = 0.0;
  for (size_t k = 0; k < anchors.vertices.size(); ++k) {
    sum += (base.col(anchors.vertices[k]) - anchors.values.col(k)).squaredNorm();
  }
  return sum;
}

Eigen::Vector3d OnPath(const ClothObject& cloth, int vertex, int frame) {
  for (const PrescribedPath& path : cloth.prescribed_paths) {
    if (path.vertex != vertex) continue;
    const int last = static_cast<int>(path.positions.cols()) - 1;
    return path.positions.col(std::min(frame, last));
  }
  return cloth.positions.segment<3>(3 * vertex);
}

class Guess {
 public:
  Guess(const Scene& scene, int object, const Observations& observations, int frame)
      : cloth_(scene.objects[object]),
        object_(object),
        observations_(observations),
        initial_(Eigen::Map<const Points>(cloth_.positions.data(), 3,
                                          cloth_.num_vertices())) {
    for (int v = 0; v < cloth_.num_vertices(); ++v) {
      if (cloth_.is_fixed[v]) {
        const Eigen::Vector3d now = OnPath(cloth_, v, frame);
        Add(v, now, &positions_);
        Add(v, (now - OnPath(cloth_, v, frame - 1)) / scene.delta, &velocities_);
      } else if (IsObserved(v, frame)) {
        Add(v, Observed(v, frame), &positions_);
        // Backward: all methods but explicit Euler move by the new velocity.
        if (!IsObserved(v, frame - 1)) continue;
        Add(v, (Observed(v, frame) - Observed(v, frame - 1)) / scene.delta,
            &velocities_);
      }
    }
  }

  StateGuess From(const Eigen::VectorXd& rollout_position,
                  const Eigen::VectorXd& rollout_velocity) const {
    const int n = cloth_.num_vertices();
    Points base = initial_;
    Points base_velocity = Points::Zero(3, n);
    const Eigen::Map<const Points> rollout(rollout_position.data(), 3, n);
    if (rollout_position.allFinite() && rollout_velocity.allFinite() &&
        SquaredDistance(rollout, positions_) <= SquaredDistance(base, positions_)) {
      base = rollout;
      base_velocity = Eigen::Map<const Points>(rollout_velocity.data(), 3, n);
    }
    StateGuess guess;
    guess.position = Interpolate(initial_, base, positions_).reshaped();
    guess.velocity = Interpolate(initial_, base_velocity, velocities_).reshaped();
    for (int v = 0; v < n; ++v) {
      if (cloth_.is_fixed[v]) guess.velocity.segment<3>(3 * v).setZero();
    }
    return guess;
  }

 private:
  static void Add(int vertex, const Eigen::Vector3d& value, Anchors* anchors) {
    anchors->vertices.push_back(vertex);
    anchors->values.conservativeResize(3, anchors->vertices.size());
    anchors->values.col(anchors->values.cols() - 1) = value;
  }

  bool IsObserved(int vertex, int frame) const {
    return frame < observations_.num_frames() &&
           observations_.IsObserved(object_, vertex, frame);
  }
  Eigen::Vector3d Observed(int vertex, int frame) const {
    return observations_.positions[object_].col(frame).segment<3>(3 * vertex);
  }

  const ClothObject& cloth_;
  int object_;
  const Observations& observations_;
  Points initial_;
  Anchors positions_, velocities_;
};

}  // namespace

StateGuess GuessState(const Scene& scene, int object, const Observations& observations,
                      const Eigen::VectorXd& rollout_position,
                      const Eigen::VectorXd& rollout_velocity, int frame) {
  return Guess(scene, object, observations, frame)
      .From(rollout_position, rollout_velocity);
}

}  // namespace dpe
