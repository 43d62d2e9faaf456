#include "simulation.h"

#include <cstddef>
#include <string>
#include <utility>

#include "errors.h"

namespace py = pybind11;

namespace dpe::python {

Simulation::Simulation(const Scene& scene, SimulatorOptions options)
    : scene_(std::make_shared<Scene>(scene)), layout_(scene) {
  options.interrupted = [this] {
    return interrupts_ != nullptr && interrupts_->Poll();
  };
  simulator_ = std::make_unique<Simulator>(scene, options);
}

PyRollout PyRollout::Run(const std::shared_ptr<Simulation>& simulation,
                         const Eigen::VectorXd& parameters, int num_frames,
                         bool check) {
  PyRollout result;
  result.simulation_ = simulation;
  Interrupts interrupts;
  result.rollout_ = simulation->Call(&interrupts, [&](Simulator* simulator) {
    result.run_ = ++simulation->run;
    return std::make_shared<Rollout>(simulator->Run(parameters, num_frames));
  });
  if (check && !result.rollout_->status().ok()) {
    RaiseSimulationError(result.rollout_->status().Message(),
                         py::cast(result.trajectory()));
  }
  return result;
}

PyTrajectory PyRollout::trajectory() const {
  return {{rollout_, &rollout_->trajectory()}, simulation_->scene_pointer()};
}

void PyRollout::RequireDerivatives() const {
  if (simulation_->layout().size() == 0) {
    throw SceneError(
        "scene: nothing is unknown, so there is nothing to differentiate by; set "
        "scene.settings (\"nL\"), scene.estimate_wind or the like");
  }
  if (!rollout_->status().ok()) {
    RaiseSimulationError(rollout_->status().Message(), py::cast(trajectory()));
  }
}

void PyRollout::RaiseFailure(const RolloutStatus& status) const {
  RaiseSimulationError(status.Message(), py::cast(trajectory()));
}

const Rollout* PyRollout::Current(Simulator* simulator) {
  if (run_ != simulation_->run) {
    run_ = ++simulation_->run;
    again_ = std::make_shared<Rollout>(
        simulator->Run(rollout_->parameters(), rollout_->trajectory().num_frames()));
  }
  return again_ != nullptr ? again_.get() : rollout_.get();
}

SimulatorOptions MakeSimulatorOptions(int threads, double memory_limit) {
  if (threads < 1) {
    throw py::value_error("threads: " + std::to_string(threads) +
                          "; accepted are 1 or more");
  }
  if (!(memory_limit >= 0.0)) {
    throw py::value_error("memory_limit: accepted are 0 or more (MiB)");
  }
  SimulatorOptions options;
  options.num_threads = threads;
  options.memory_limit_bytes = static_cast<std::size_t>(memory_limit * (1 << 20));
  return options;
}

}  // namespace dpe::python
