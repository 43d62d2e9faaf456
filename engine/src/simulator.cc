#include "dpe/engine/simulator.h"

#include <cmath>
#include <limits>

#include "dpe/engine/scene_io.h"
#include "integrators/integrator.h"
#include "object_system.h"
#include "parallel.h"
#include "rollout_tape.h"

namespace dpe {
namespace {

// Beyond this a rollout counts as diverged, long before overflow, m.
constexpr double kMaxCoordinate = 1e12;

bool InRange(const Eigen::Ref<const Eigen::VectorXd>& x) {
  return x.allFinite() && x.cwiseAbs().maxCoeff() < kMaxCoordinate;
}

// Integrates one object. Fills `tape` (every step) or, without one, `trajectory`'s
// frames from two alternating columns.
RolloutStatus RollOutObject(const Scene& scene, const SimulatorOptions& options,
                            int object, int num_frames, ObjectSystem* system,
                            ObjectTape* tape, Trajectory* trajectory) {
  const double h = scene.step_length();
  const int n = system->num_coordinates();
  const int num_steps = (num_frames - 1) * scene.steps_per_frame;
  ObjectTape two_columns;
  const bool keep = tape != nullptr;
  if (!keep) tape = &two_columns;
  const int columns = keep ? num_steps + 1 : 2;
  tape->positions.resize(n, columns);
  tape->velocities.resize(n, columns);
  tape->positions.col(0) = system->initial_positions();
  tape->velocities.col(0) = system->initial_velocities();
  trajectory->positions[object].col(0) = tape->positions.col(0);
  trajectory->velocities[object].col(0) = tape->velocities.col(0);

  const std::unique_ptr<Integrator> integrator =
      MakeIntegrator(scene.integration_method, options);
  Eigen::VectorXd v0(n);
  RolloutStatus status;
  status.object = object;
  for (int s = 0; s < num_steps; ++s) {
    auto x0 = tape->positions.col(keep ? s : s % 2);
    auto x1 = tape->positions.col(keep ? s + 1 : (s + 1) % 2);
    auto v1 = tape->velocities.col(keep ? s + 1 : (s + 1) % 2);
    x1 = x0;
    system->SetPrescribedPositions(s + 1, x1.data());
    v0 = tape->velocities.col(keep ? s : s % 2);
    system->SetPrescribedVelocities(h, x0.data(), x1.data(), v0.data());
    v1 = v0;
    StepOutcome outcome;
    if (options.interrupted && options.interrupted()) {
      outcome.code = RolloutStatus::Code::kInterrupted;
    } else {
      outcome =
          integrator->Step(system, {h, x0.data(), v0.data(), x1.data(), v1.data()},
                           x1.data(), v1.data());
      if (outcome.ok() && !(InRange(x1) && v1.allFinite())) {
        outcome.code = RolloutStatus::Code::kNotFinite;
      }
    }
    const int frame = s / scene.steps_per_frame + 1;
    if (!outcome.ok()) {
      status.code = outcome.code;
      status.reason = outcome.reason;
      status.frame = frame;
      status.step = s % scene.steps_per_frame;
      return status;
    }
    if ((s + 1) % scene.steps_per_frame == 0) {
      trajectory->positions[object].col(frame) = x1;
      trajectory->velocities[object].col(frame) = v1;
    }
  }
  return status;
}

}  // namespace

Rollout::Rollout() = default;
Rollout::Rollout(Rollout&&) noexcept = default;
Rollout& Rollout::operator=(Rollout&&) noexcept = default;
Rollout::~Rollout() = default;

Simulator::Simulator(const Scene& scene, const SimulatorOptions& options)
    : scene_(scene), options_(options) {
  ValidateScene(scene, "scene");
  layout_ = ParameterLayout(scene);
  for (int o = 0; o < static_cast<int>(scene.objects.size()); ++o) {
    const bool wanted =
        !options.only_estimated_objects || ParameterLayout::ObjectIsEstimated(scene, o);
    systems_.push_back(wanted ? std::make_unique<ObjectSystem>(scene_, o, layout_)
                              : nullptr);
  }
}

Simulator::~Simulator() = default;

void Simulator::SetParameters(const Eigen::VectorXd& parameters) {
  current_parameters_ = parameters;
  layout_.Insert(parameters, &scene_);
  for (const auto& system : systems_) {
    if (system) system->SetParameters(scene_);
  }
}

Trajectory Simulator::RollOut(int num_frames, RolloutTape* tape) {
  const int num_objects = static_cast<int>(systems_.size());
  Trajectory trajectory;
  trajectory.positions.resize(num_objects);
  trajectory.velocities.resize(num_objects);
  if (tape != nullptr) {
    tape->objects.resize(num_objects);
    tape->steps_per_frame = scene_.steps_per_frame;
  }
  std::vector<RolloutStatus> statuses(num_objects);
  ParallelFor(options_.num_threads, num_objects, [&](int o) {
    if (!systems_[o]) return;
    const double nan = std::numeric_limits<double>::quiet_NaN();
    for (auto* states : {&trajectory.positions[o], &trajectory.velocities[o]}) {
      states->setConstant(systems_[o]->num_coordinates(), num_frames, nan);
    }
    statuses[o] = RollOutObject(scene_, options_, o, num_frames, systems_[o].get(),
                                tape ? &tape->objects[o] : nullptr, &trajectory);
  });
  for (const RolloutStatus& status : statuses) {
    if (!status.ok() && trajectory.status.ok()) trajectory.status = status;
  }
  return trajectory;
}

Trajectory Simulator::Simulate(int num_frames) { return RollOut(num_frames, nullptr); }

Rollout Simulator::Run(const Eigen::VectorXd& parameters, int num_frames) {
  SetParameters(parameters);
  Rollout rollout;
  rollout.parameters_ = parameters;
  rollout.tape_ = std::make_unique<RolloutTape>();
  rollout.trajectory_ = RollOut(num_frames, rollout.tape_.get());
  return rollout;
}

void Simulator::StepResidual(int object, double h, const Eigen::VectorXd& x0,
                             const Eigen::VectorXd& v0, const Eigen::VectorXd& x1,
                             const Eigen::VectorXd& v1,
                             const Eigen::VectorXd& parameters,
                             Eigen::VectorXd* residual,
                             std::vector<Eigen::Triplet<double>>* jacobian) {
  // Eigen compares vectors of equal size only.
  if (parameters.size() != current_parameters_.size() ||
      parameters != current_parameters_) {
    SetParameters(parameters);
  }
  ObjectSystem& system = *systems_[object];
  const std::unique_ptr<Integrator> integrator =
      MakeIntegrator(scene_.integration_method, options_);
  const StepStates states{h, x0.data(), v0.data(), x1.data(), v1.data()};
  const ForceState point = integrator->ExpansionPoint(system, states);
  residual->resize(system.num_coordinates());
  system.Force(point, residual->data());
  Eigen::VectorXd dv = Eigen::VectorXd::Zero(system.num_coordinates());
  *residual *= -h;
  for (int i : system.free_vertices()) {
    dv.segment<3>(3 * i) = v1.segment<3>(3 * i) - v0.segment<3>(3 * i);
    residual->segment<3>(3 * i) += system.parameters().mass[i] * dv.segment<3>(3 * i);
  }
  std::vector<ParameterEntry> entries;
  ParameterSink sink(system.columns(), 1.0, system.node_of_vertex(), &entries);
  system.VisitStepParameters(point, h, dv.data(), &sink);
  for (const ParameterEntry& e : entries) {
    jacobian->emplace_back(e.row, e.column, -e.value);
  }
}

}  // namespace dpe
