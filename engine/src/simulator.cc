#include "dpe/engine/simulator.h"

#include <limits>

#include "dpe/engine/parallel.h"
#include "dpe/engine/scene_io.h"
#include "integrators/integrator.h"
#include "memory_plan.h"
#include "object_rollout.h"
#include "object_system.h"
#include "rollout_tape.h"

namespace dpe {
Rollout::Rollout() = default;
Rollout::Rollout(Rollout&&) noexcept = default;
Rollout& Rollout::operator=(Rollout&&) noexcept = default;
Rollout::~Rollout() = default;

std::size_t Rollout::kept_bytes() const { return tape_ ? tape_->bytes() : 0; }

Simulator::Simulator(const Scene& scene, const SimulatorOptions& options)
    : scene_(scene), options_(options) {
  ValidateScene(scene, "scene");
  layout_ = ParameterLayout(scene);
  for (int o = 0; o < static_cast<int>(scene.objects.size()); ++o) {
    const bool wanted =
        !options.only_estimated_objects || ParameterLayout::ObjectIsEstimated(scene, o);
    systems_.push_back(
        wanted ? std::make_unique<ObjectSystem>(scene_, o, layout_, options.timings)
               : nullptr);
    factor_pools_.push_back(std::make_shared<FactorPool>());
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
  MemoryPlan plan;
  if (tape != nullptr) {
    tape->objects.resize(num_objects);
    std::vector<MemoryDemand> demands;
    for (const auto& system : systems_) {
      if (system) demands.push_back(DemandOf(scene_, options_, *system));
    }
    plan = PlanMemory(options_.memory_limit_bytes, num_frames - 1,
                      scene_.steps_per_frame, demands);
  }
  std::vector<RolloutStatus> statuses(num_objects);
  ParallelFor(options_.num_threads, num_objects, [&](int o) {
    if (!systems_[o]) return;
    const double nan = std::numeric_limits<double>::quiet_NaN();
    for (auto* states : {&trajectory.positions[o], &trajectory.velocities[o]}) {
      states->setConstant(systems_[o]->num_coordinates(), num_frames, nan);
    }
    if (tape != nullptr) tape->objects[o].pool = factor_pools_[o];
    statuses[o] = RollOutObject(scene_, options_, o, plan, systems_[o].get(),
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
  const StepStates states{h,         x0.data(), v0.data(), x1.data(),
                          v1.data(), nullptr,   nullptr};
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
