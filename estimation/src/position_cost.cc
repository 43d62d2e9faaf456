#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "dpe/engine/parameters.h"
#include "dpe/estimation/trajectory_cost.h"
#include "frame_interpolation.h"

namespace dpe {
namespace {

using States = std::vector<TrajectoryCost::StateReference>;

// Gathers observations as rows of a linear map from states: for each state that they
// read the map's entries, and the target.
class RowBuilder {
 public:
  explicit RowBuilder(const Scene& scene) : scene_(scene) {}

  bool empty() const { return target_.empty(); }

  // Starts the three rows of one observation.
  void Begin(const Eigen::Vector3d& position, double sigma) {
    weight_ = sigma > 0.0 ? 1.0 / sigma : 1.0;
    for (int c = 0; c < 3; ++c) target_.push_back(weight_ * position[c]);
  }

  // Adds `weight` times a vertex's position at a frame to them.
  void Add(int object, int frame, int vertex, double weight) {
    const int row = static_cast<int>(target_.size()) - 3;
    Entries& entries = entries_[{object, frame}];
    for (int c = 0; c < 3; ++c) {
      entries.emplace_back(row + c, 3 * vertex + c, weight_ * weight);
    }
  }

  Eigen::VectorXd target() const {
    return Eigen::Map<const Eigen::VectorXd>(target_.data(), target_.size());
  }

  std::vector<StateDerivative> terms() const {
    std::vector<StateDerivative> terms;
    for (const auto& [state, entries] : entries_) {
      StateDerivative term;
      term.object = state.first;
      term.frame = state.second;
      FirstAndLastRow(entries, &term);
      terms.push_back(std::move(term));
    }
    return terms;
  }

 private:
  using Entries = std::vector<Eigen::Triplet<double>>;

  // Rows above the first and below the last entry are left out.
  void FirstAndLastRow(const Entries& entries, StateDerivative* term) const {
    term->first_row = entries.front().row();
    const int end = entries.back().row() + 1;
    Entries local;
    local.reserve(entries.size());
    for (const auto& entry : entries) {
      local.emplace_back(entry.row() - term->first_row, entry.col(), entry.value());
    }
    term->d_position.resize(end - term->first_row,
                            scene_.objects[term->object].positions.size());
    term->d_position.setFromTriplets(local.begin(), local.end());
  }

  const Scene& scene_;
  double weight_ = 1.0;
  std::vector<double> target_;
  std::map<std::pair<int, int>, Entries> entries_;  // by object and frame
};

States StatesOf(const std::vector<StateDerivative>& terms) {
  States states;
  for (const StateDerivative& term : terms) {
    states.push_back({term.object, term.frame});
  }
  return states;
}

RobustLoss LossOf(const PositionCostOptions& options) {
  return RobustLoss(options.loss, options.loss_scale > 0.0
                                      ? options.loss_scale
                                      : RobustLoss::DefaultScale(options.loss));
}

// For each marker whether any parameter moves it.
std::vector<char> MovedMarkers(const Scene& scene, const Observations& observations) {
  if (observations.markers.empty()) return {};
  const std::vector<char> is_estimated = ParameterLayout::EstimatedObjects(scene);
  std::vector<char> is_moved;
  for (const Marker& marker : observations.markers) {
    is_moved.push_back(0);
    if (!is_estimated[marker.object]) continue;
    for (size_t i = 0; i < marker.vertices.size(); ++i) {
      if (marker.weights[i] != 0.0 &&
          !scene.objects[marker.object].is_fixed[marker.vertices[i]]) {
        is_moved.back() = 1;
      }
    }
  }
  return is_moved;
}

// The derivative of robust residuals: each three rows of `rows` times their block.
SparseRows Bend(const std::vector<Eigen::Matrix3d>& bends, int first_row,
                const SparseRows& rows) {
  const int first = first_row / 3;
  const int count = static_cast<int>(rows.rows()) / 3;
  SparseRows blocks(rows.rows(), rows.rows());
  blocks.reserve(Eigen::VectorXi::Constant(rows.rows(), 3));
  for (int i = 0; i < count; ++i) {
    for (int r = 0; r < 3; ++r) {
      for (int c = 0; c < 3; ++c) {
        blocks.insert(3 * i + r, 3 * i + c) = bends[first + i](r, c);
      }
    }
  }
  return SparseRows(blocks * rows);
}

// Throws unless the noise of all observations is known, or that of none.
class NoiseCheck {
 public:
  void See(double sigma) {
    (sigma > 0.0 ? num_known_ : num_unknown_) += 1;
    if (num_known_ > 0 && num_unknown_ > 0) {
      throw SceneError(
          "the noise (sigma) of some observations is given and that of others is not; "
          "accepted are all or none (a common sigma fills what is missing)");
    }
  }

 private:
  long num_known_ = 0;
  long num_unknown_ = 0;
};

void CheckNoise(const Scene& scene, const Observations& observations, int num_frames) {
  NoiseCheck check;
  const std::vector<char> is_estimated = ParameterLayout::EstimatedObjects(scene);
  for (int object = 0; object < static_cast<int>(observations.positions.size());
       ++object) {
    const int frames = std::min<int>(num_frames, observations.positions[object].cols());
    if (is_estimated[object] == 0) continue;
    for (int frame = 1; frame < frames; ++frame) {
      for (int v = 0; v < scene.objects[object].num_vertices(); ++v) {
        if (!scene.objects[object].is_fixed[v] &&
            observations.IsObserved(object, v, frame)) {
          check.See(observations.Sigma(object, v, frame));
        }
      }
    }
  }
  const std::vector<char> is_moved = MovedMarkers(scene, observations);
  for (const MarkerSample& sample : observations.samples) {
    if (is_moved[sample.marker] != 0) {
      check.See(observations.Sigma(sample));
    }
  }
}

}  // namespace

PositionCost::PositionCost(Eigen::VectorXd target, std::vector<StateDerivative> terms,
                           const RobustLoss& loss)
    : TrajectoryCost(static_cast<int>(target.size()), StatesOf(terms)),
      target_(std::move(target)),
      terms_(std::move(terms)),
      loss_(loss) {}

std::unique_ptr<PositionCost> PositionCost::Create(const Scene& scene,
                                                   const Observations& observations,
                                                   int frame,
                                                   const PositionCostOptions& options) {
  RowBuilder rows(scene);
  const std::vector<char> is_estimated = ParameterLayout::EstimatedObjects(scene);
  for (int object = 0; object < static_cast<int>(scene.objects.size()); ++object) {
    if (is_estimated[object] == 0) continue;
    const ClothObject& cloth = scene.objects[object];
    for (int v = 0; v < cloth.num_vertices(); ++v) {
      if (cloth.is_fixed[v] || !observations.IsObserved(object, v, frame)) continue;
      rows.Begin(observations.positions[object].col(frame).segment<3>(3 * v),
                 observations.Sigma(object, v, frame));
      rows.Add(object, frame, v, 1.0);
    }
  }
  if (rows.empty()) return nullptr;
  return std::unique_ptr<PositionCost>(
      new PositionCost(rows.target(), rows.terms(), LossOf(options)));
}

std::unique_ptr<PositionCost> PositionCost::CreateFromSamples(
    const Scene& scene, const Observations& observations, int frame, int num_frames,
    const PositionCostOptions& options) {
  if (observations.samples.empty()) return nullptr;
  RowBuilder rows(scene);
  const std::vector<char> is_moved = MovedMarkers(scene, observations);
  for (const MarkerSample& sample : observations.samples) {
    if (!IsWithinFrames(sample.time, num_frames)) continue;
    const FrameWeights frames = InterpolateFrames(sample.time, num_frames);
    const int own_frame =
        frames.count == 1 ? frames.first : static_cast<int>(std::floor(sample.time));
    const Marker& marker = observations.markers[sample.marker];
    const bool is_given = frames.count == 1 && frames.first == 0;
    if (own_frame != frame || is_given || is_moved[sample.marker] == 0) continue;
    rows.Begin(sample.position, observations.Sigma(sample));
    for (int k = 0; k < frames.count; ++k) {
      for (size_t i = 0; i < marker.vertices.size(); ++i) {
        const double weight = frames.weights[k] * marker.weights[i];
        if (weight == 0.0) continue;
        rows.Add(marker.object, frames.first + k, marker.vertices[i], weight);
      }
    }
  }
  if (rows.empty()) return nullptr;
  return std::unique_ptr<PositionCost>(
      new PositionCost(rows.target(), rows.terms(), LossOf(options)));
}

bool PositionCost::Evaluate(const Trajectory& trajectory, double* residuals,
                            std::vector<StateDerivative>* derivatives) const {
  Eigen::Map<Eigen::VectorXd> r(residuals, num_residuals());
  r = -target_;
  for (const StateDerivative& term : terms_) {
    r.segment(term.first_row, term.d_position.rows()) +=
        term.d_position * trajectory.positions[term.object].col(term.frame);
  }
  if (loss_.type() == LossType::kNone) {
    if (derivatives != nullptr) {
      derivatives->insert(derivatives->end(), terms_.begin(), terms_.end());
    }
    return true;
  }
  std::vector<Eigen::Matrix3d> bends(r.size() / 3);
  for (size_t i = 0; i < bends.size(); ++i) bends[i] = loss_.Apply(r.segment<3>(3 * i));
  if (derivatives == nullptr) return true;
  for (const StateDerivative& term : terms_) {
    derivatives->push_back(term);
    derivatives->back().d_position = Bend(bends, term.first_row, term.d_position);
  }
  return true;
}

TrajectoryCosts MakePositionCosts(const Scene& scene, const Observations& observations,
                                  int num_frames, const PositionCostOptions& options) {
  CheckNoise(scene, observations, num_frames);
  TrajectoryCosts costs;
  for (int frame = 0; frame < num_frames; ++frame) {
    std::unique_ptr<PositionCost> cost =
        frame > 0 ? PositionCost::Create(scene, observations, frame, options) : nullptr;
    if (cost != nullptr) costs.push_back(std::move(cost));
    cost = PositionCost::CreateFromSamples(scene, observations, frame, num_frames,
                                           options);
    if (cost != nullptr) costs.push_back(std::move(cost));
  }
  return costs;
}

}  // namespace dpe
