#include "dpe/estimation/trajectory_evaluator.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <utility>

#include "dpe/engine/parallel.h"
#include "dpe/engine/scene_io.h"
#include "link_cost.h"
#include "prior_rows.h"
#include "segment_rollout.h"

namespace dpe {
namespace {

SimulatorOptions MakeSimulatorOptions(const TrajectoryEvaluatorOptions& options,
                                      int num_segments) {
  SimulatorOptions simulator_options;
  simulator_options.only_estimated_objects = true;
  // Segments come first: they share nothing.
  simulator_options.num_threads = std::max(1, options.num_threads / num_segments);
  simulator_options.memory_limit_bytes = options.memory_limit_bytes / num_segments;
  simulator_options.interrupted = options.interrupted;
  simulator_options.timings = options.timings;
  return simulator_options;
}

std::vector<TrajectorySegment> OneSegment(const Scene& scene, TrajectoryCosts costs) {
  std::vector<TrajectorySegment> segments(1);
  segments[0].scene = scene;
  segments[0].costs = std::move(costs);
  return segments;
}

void CheckLinks(const std::vector<SegmentLink>& links, int num_segments) {
  for (const SegmentLink& link : links) {
    if (link.from >= 0 && link.to >= 0 && link.from < num_segments &&
        link.to < num_segments && link.from != link.to && link.frame >= 0) {
      continue;
    }
    throw SceneError("a link from segment " + std::to_string(link.from) + ", frame " +
                     std::to_string(link.frame) + ", to segment " +
                     std::to_string(link.to) + " is not accepted; there are " +
                     std::to_string(num_segments) + " segments");
  }
}

}  // namespace

TrajectoryEvaluator::TrajectoryEvaluator(const Scene& scene, TrajectoryCosts costs,
                                         const TrajectoryEvaluatorOptions& options)
    : TrajectoryEvaluator(OneSegment(scene, std::move(costs)), {}, options) {}

TrajectoryEvaluator::TrajectoryEvaluator(std::vector<TrajectorySegment> segments,
                                         std::vector<SegmentLink> links,
                                         const TrajectoryEvaluatorOptions& options)
    : options_(options), best_cost_(std::numeric_limits<double>::infinity()) {
  if (segments.empty()) throw SceneError("a fit needs at least one segment");
  CheckLinks(links, static_cast<int>(segments.size()));
  if (segments.size() > 1) {  // a simulator checks its scene, but only its own
    for (size_t s = 0; s < segments.size(); ++s) {
      ValidateScene(segments[s].scene, "scene " + std::to_string(s));
    }
  }
  MakeSegments(std::move(segments), links);
}

TrajectoryEvaluator::~TrajectoryEvaluator() = default;

void TrajectoryEvaluator::MakeSegments(std::vector<TrajectorySegment> segments,
                                       const std::vector<SegmentLink>& links) {
  std::vector<const Scene*> scenes;
  for (const TrajectorySegment& segment : segments) scenes.push_back(&segment.scene);
  joint_ = std::make_unique<JointLayout>(scenes, options_.own_wind);
  map_ = ParameterMap(layout());
  prior_rows_ = std::make_unique<PriorRows>(segments[0].scene, layout(),
                                            options_.priors, options_.smoothness);
  const int num_segments = static_cast<int>(segments.size());
  links_.resize(links.size());
  int num_rows = 0;
  for (int s = 0; s < num_segments; ++s) {
    const size_t first_cost = costs_.size();
    for (auto& cost : segments[s].costs) costs_.push_back(std::move(cost));
    for (size_t k = 0; k < links.size(); ++k) {
      if (links[k].from != s) continue;
      const int to = links[k].to;
      auto cost = LinkCost::Create(links[k], ParameterLayout(segments[to].scene));
      links_[k] = {static_cast<int>(costs_.size()), to, cost.get(), {}};
      for (int own : cost->parameters()) {
        links_[k].parameters.push_back(joint_->indices(to)[own]);
      }
      costs_.push_back(std::move(cost));
    }
    std::vector<const TrajectoryCost*> of_segment;
    for (size_t i = first_cost; i < costs_.size(); ++i) {
      of_segment.push_back(costs_[i].get());
      segment_of_cost_.push_back(s);
    }
    segments_.push_back(
        std::make_unique<SegmentRollout>(segments[s].scene, std::move(of_segment),
                                         MakeSimulatorOptions(options_, num_segments)));
    segment_rows_.push_back(num_rows);
    for (size_t i = first_cost; i < costs_.size(); ++i) {
      first_rows_.push_back(num_rows +
                            segments_[s]->first_row(static_cast<int>(i - first_cost)));
    }
    num_rows += segments_[s]->num_residuals();
  }
  residuals_.resize(num_rows);
}

Simulator* TrajectoryEvaluator::simulator(int segment) {
  return segments_[segment]->simulator();
}

int TrajectoryEvaluator::num_frames(int segment) const {
  return segments_[segment]->num_frames();
}

const RowMajorMatrix& TrajectoryEvaluator::jacobian(int segment) const {
  return segments_[segment]->jacobian();
}

const Trajectory& TrajectoryEvaluator::trajectory(int segment) const {
  return segments_[segment]->rollout().trajectory();
}

bool TrajectoryEvaluator::Fail(const std::string& message) {
  ok_ = false;
  message_ = message;
  return false;
}

void TrajectoryEvaluator::Forget() {
  coordinates_.resize(0);
  ok_ = false;
  jacobian_is_current_ = false;
}

// The first failure of several segments is the one that is told.
bool TrajectoryEvaluator::AllOk(const std::vector<char>& ok) {
  for (size_t s = 0; s < ok.size(); ++s) {
    if (ok[s]) continue;
    message_ = segments_[s]->message();
    if (ok.size() > 1) message_ = "segment " + std::to_string(s) + ": " + message_;
    return false;
  }
  return true;
}

bool TrajectoryEvaluator::Evaluate(const Eigen::VectorXd& coordinates) {
  if (coordinates_.size() == coordinates.size() && coordinates_ == coordinates) {
    return ok_;
  }
  jacobian_is_current_ = false;
  coordinates_ = coordinates;
  const Eigen::VectorXd parameters = map_.ToParameters(coordinates);
  if (!parameters.allFinite()) return Fail("a parameter is not a finite number");
  std::vector<char> ok(num_segments(), 0);
  ParallelFor(options_.num_threads, num_segments(), [&](int s) {
    ok[s] = segments_[s]->Evaluate(joint_->Gather(parameters, s),
                                   residuals_.data() + segment_rows_[s]);
  });
  num_rollouts_ += num_segments();
  if (!AllOk(ok)) {
    for (const auto& segment : segments_) {
      // An interrupted rollout says nothing about this point: do not remember it.
      if (segment->was_interrupted()) coordinates_.resize(0);
    }
    return Fail(message_);
  }
  SubtractLinkTargets(parameters);
  prior_cost_ = prior_rows_->Cost(coordinates);
  if (!std::isfinite(cost())) return Fail("the cost is not a finite number");
  ok_ = true;
  message_.clear();
  if (cost() < best_cost_) {
    best_cost_ = cost();
    best_coordinates_ = coordinates_;
    if (options_.improved) options_.improved();
  }
  return true;
}

void TrajectoryEvaluator::SubtractLinkTargets(const Eigen::VectorXd& parameters) {
  for (const Link& link : links_) {
    const int row = first_rows_[link.cost];
    for (size_t i = 0; i < link.parameters.size(); ++i) {
      residuals_[row + i] -= link.state->weights()[i] * parameters[link.parameters[i]];
    }
  }
}

bool TrajectoryEvaluator::CostOverHorizon(const Eigen::VectorXd& coordinates,
                                          int num_frames, double* cost) {
  assert(links_.empty());
  const Eigen::VectorXd parameters = map_.ToParameters(coordinates);
  if (!parameters.allFinite()) return false;
  Forget();
  std::vector<char> ok(num_segments(), 0);
  std::vector<double> parts(num_segments(), 0.0);
  ParallelFor(options_.num_threads, num_segments(), [&](int s) {
    ok[s] = segments_[s]->CostOverHorizon(joint_->Gather(parameters, s), num_frames,
                                          &parts[s]);
  });
  num_rollouts_ += num_segments();
  *cost = prior_rows_->Cost(coordinates);
  for (double part : parts) *cost += part;
  return std::all_of(ok.begin(), ok.end(), [](char c) { return c != 0; });
}

bool TrajectoryEvaluator::EvaluateJacobian() {
  if (!ok_) return false;
  if (jacobian_is_current_) return true;
  const Eigen::VectorXd dp_dq = map_.Derivative(coordinates_);
  std::vector<char> ok(num_segments(), 0);
  ParallelFor(options_.num_threads, num_segments(), [&](int s) {
    ok[s] = segments_[s]->EvaluateJacobian(options_.jacobian, joint_->Gather(dp_dq, s));
  });
  num_derivative_passes_ += num_segments();
  jacobian_is_current_ = AllOk(ok);
  return jacobian_is_current_;
}

RowMajorMatrix TrajectoryEvaluator::DenseJacobian() const {
  RowMajorMatrix dense = RowMajorMatrix::Zero(num_residuals(), num_parameters());
  for (int s = 0; s < num_segments(); ++s) {
    const RowMajorMatrix& part = jacobian(s);
    const std::vector<int>& columns = joint_->indices(s);
    for (int row = 0; row < part.rows(); ++row) {
      for (int k = 0; k < part.cols(); ++k) {
        dense(segment_rows_[s] + row, columns[k]) = part(row, k);
      }
    }
  }
  for (const Link& link : links_) {  // initial states are their own coordinates
    for (size_t i = 0; i < link.parameters.size(); ++i) {
      dense(first_rows_[link.cost] + i, link.parameters[i]) -= link.state->weights()[i];
    }
  }
  return dense;
}

Eigen::VectorXd TrajectoryEvaluator::JacobianColumnSquares() const {
  Eigen::VectorXd squares = Eigen::VectorXd::Zero(num_parameters());
  for (int s = 0; s < num_segments(); ++s) {
    const RowMajorMatrix& part = jacobian(s);
    Eigen::VectorXd own = Eigen::VectorXd::Zero(part.cols());
    for (int row = 0; row < part.rows(); ++row) own += part.row(row).cwiseAbs2();
    joint_->ScatterAdd(own, s, &squares);
  }
  return squares;
}

bool TrajectoryEvaluator::EvaluateGradient(Eigen::VectorXd* gradient) {
  if (!ok_) return false;
  std::vector<char> ok(num_segments(), 0);
  std::vector<Eigen::VectorXd> parts(num_segments());
  ParallelFor(options_.num_threads, num_segments(), [&](int s) {
    ok[s] =
        segments_[s]->EvaluateGradient(residuals_.data() + segment_rows_[s], &parts[s]);
  });
  num_derivative_passes_ += num_segments();
  if (!AllOk(ok)) return false;
  gradient->setZero(num_parameters());
  for (int s = 0; s < num_segments(); ++s) joint_->ScatterAdd(parts[s], s, gradient);
  for (const Link& link : links_) {
    for (size_t i = 0; i < link.parameters.size(); ++i) {
      (*gradient)[link.parameters[i]] -=
          link.state->weights()[i] * residuals_[first_rows_[link.cost] + i];
    }
  }
  gradient->array() *= map_.Derivative(coordinates_).array();
  prior_rows_->AddGradient(coordinates_, gradient);
  return true;
}

void TrajectoryEvaluator::SetLinkWeights(int link, double position_weight,
                                         double velocity_weight) {
  links_[link].state->SetWeights(position_weight, velocity_weight);
  for (const auto& segment : segments_) segment->Forget();
  Forget();
  best_coordinates_.resize(0);
  best_cost_ = std::numeric_limits<double>::infinity();
}

const TrajectoryEvaluator::Link* TrajectoryEvaluator::FindLink(int cost) const {
  for (const Link& link : links_) {
    if (link.cost == cost) return &link;
  }
  return nullptr;
}

std::vector<TrajectoryEvaluator::LinkTerm> TrajectoryEvaluator::LinkTerms(
    int cost) const {
  std::vector<LinkTerm> terms;
  const Link* link = FindLink(cost);
  if (link == nullptr) return terms;
  for (size_t i = 0; i < link->parameters.size(); ++i) {
    terms.push_back({link->parameters[i], link->state->weights()[i]});
  }
  return terms;
}

int TrajectoryEvaluator::LinkTarget(int cost) const {
  const Link* link = FindLink(cost);
  return link == nullptr ? -1 : link->to;
}

std::string TrajectoryEvaluator::JacobianMethodName() {
  JacobianMethod method = options_.jacobian;
  if (method == JacobianMethod::kAuto && ok_) method = segments_[0]->CheaperMethod();
  return method == JacobianMethod::kAdjoint ? "adjoint" : "tangent";
}

}  // namespace dpe
