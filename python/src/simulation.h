// A simulator and its rollouts as Python holds them.
//
// A Sensitivity needs its simulator to be as the rollout left it. Python may run a
// simulator again, from several threads too, while it holds older rollouts: a mutex
// (taken without the GIL) puts the calls in a row, and a rollout whose simulator has
// moved on is run once more, to the same numbers, before it is differentiated.
#ifndef DPE_PYTHON_SIMULATION_H_
#define DPE_PYTHON_SIMULATION_H_

#include <pybind11/pybind11.h>

#include <Eigen/Core>
#include <memory>
#include <mutex>

#include "dpe/engine/sensitivity.h"
#include "dpe/engine/simulator.h"
#include "long_call.h"
#include "trajectory.h"

namespace dpe::python {

class Simulation {
 public:
  // @throws SceneError
  Simulation(const Scene& scene, SimulatorOptions options);

  // Of the scene as it was given.
  const Scene& scene() const { return *scene_; }
  std::shared_ptr<const Scene> scene_pointer() const { return scene_; }
  const ParameterLayout& layout() const { return layout_; }

  // Calls work(simulator) without the GIL, alone, and with `interrupts` polled.
  template <class Work>
  auto Call(Interrupts* interrupts, const Work& work) {
    return CallLong(interrupts, [&] {
      const std::lock_guard<std::mutex> lock(mutex_);
      const Polled polled(this, interrupts);
      return work(simulator_.get());
    });
  }

  // Counts what changes the simulator's parameters; read and written within Call.
  long run = 0;

 private:
  class Polled {
   public:
    Polled(Simulation* simulation, Interrupts* interrupts) : simulation_(simulation) {
      simulation_->interrupts_ = interrupts;
    }
    ~Polled() { simulation_->interrupts_ = nullptr; }
    Polled(const Polled&) = delete;
    Polled& operator=(const Polled&) = delete;

   private:
    Simulation* simulation_;
  };

  std::shared_ptr<const Scene> scene_;
  ParameterLayout layout_;
  std::mutex mutex_;
  Interrupts* interrupts_ = nullptr;  // of the call that holds the mutex
  std::unique_ptr<Simulator> simulator_;
};

class PyRollout {
 public:
  static PyRollout Run(const std::shared_ptr<Simulation>& simulation,
                       const Eigen::VectorXd& parameters, int num_frames, bool check);

  PyTrajectory trajectory() const;
  const Rollout& rollout() const { return *rollout_; }
  const Simulation& simulation() const { return *simulation_; }

  // Calls work(&sensitivity), as Simulation::Call.
  // @throws SimulationError if the rollout had failed or the derivatives fail: where
  //         and why
  template <class Work>
  auto Differentiate(const Work& work) {
    RequireDerivatives();
    Interrupts interrupts;
    RolloutStatus status;
    auto result = simulation_->Call(&interrupts, [&](Simulator* simulator) {
      Sensitivity sensitivity(simulator, Current(simulator));
      auto value = work(&sensitivity);
      status = sensitivity.status();
      return value;
    });
    if (!status.ok()) RaiseFailure(status);
    return result;
  }

 private:
  void RequireDerivatives() const;
  [[noreturn]] void RaiseFailure(const RolloutStatus& status) const;
  const Rollout* Current(Simulator* simulator);

  std::shared_ptr<Simulation> simulation_;
  std::shared_ptr<Rollout> rollout_;  // whose trajectory Python may hold
  std::shared_ptr<Rollout> again_;    // the same, run after the simulator had moved on
  long run_ = 0;                      // of the newer one of the two
};

// @param threads, memory_limit  MiB, as in the command line programs
// @throws ValueError
SimulatorOptions MakeSimulatorOptions(int threads, double memory_limit);

}  // namespace dpe::python

#endif  // DPE_PYTHON_SIMULATION_H_
