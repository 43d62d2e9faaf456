// What a rollout leaves behind for its derivative passes: the states before and after
// every step of every simulated object, and as many factorised step matrices as fit.
#ifndef DPE_ENGINE_ROLLOUT_TAPE_H_
#define DPE_ENGINE_ROLLOUT_TAPE_H_

#include <Eigen/Core>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

#include "integrators/integrator.h"
#include "object_system.h"

namespace dpe {

// Solvers that earlier rollouts of an object have handed back.
class SolverPool {
 public:
  std::unique_ptr<StepSolver> Take(const ObjectSystem& system) {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (solvers_.empty()) return system.NewSolver();
    std::unique_ptr<StepSolver> solver = std::move(solvers_.back());
    solvers_.pop_back();
    return solver;
  }
  void Return(std::unique_ptr<StepSolver> solver) {
    const std::lock_guard<std::mutex> lock(mutex_);
    solvers_.push_back(std::move(solver));
  }

 private:
  std::mutex mutex_;
  std::vector<std::unique_ptr<StepSolver>> solvers_;
};

struct ObjectTape {
  ObjectTape() = default;
  ObjectTape(ObjectTape&&) = default;
  ObjectTape& operator=(ObjectTape&&) = default;
  ~ObjectTape() {
    for (auto& solver : solvers) {
      if (solver) pool->Return(std::move(solver));
    }
  }

  // Column s is the state after s steps, 3N x (steps + 1). Velocities of fixed vertices
  // in column s are those of the step that ends there.
  Eigen::MatrixXd positions;
  Eigen::MatrixXd velocities;
  // Column s is the stage within step s, for methods with two stages; else 0 x 0.
  Eigen::MatrixXd stage_positions;
  Eigen::MatrixXd stage_velocities;
  // solvers[s] is the solver of step s as the step left it; the first ones that fit
  // into the memory limit.
  std::vector<std::unique_ptr<StepSolver>> solvers;
  std::shared_ptr<SolverPool> pool;
};

class RolloutTape {
 public:
  std::vector<ObjectTape> objects;  // empty matrices: not simulated
};

// The states around step `s` (0-based) of a tape. v0 is copied into `v0_buffer` because
// its fixed entries must hold the velocity over this step.
inline StepStates StatesOfStep(const ObjectSystem& system, const ObjectTape& tape,
                               int s, double h, Eigen::VectorXd* v0_buffer) {
  *v0_buffer = tape.velocities.col(s);
  system.SetPrescribedVelocities(h, tape.positions.col(s).data(),
                                 tape.positions.col(s + 1).data(), v0_buffer->data());
  StepStates states{h,
                    tape.positions.col(s).data(),
                    v0_buffer->data(),
                    tape.positions.col(s + 1).data(),
                    tape.velocities.col(s + 1).data(),
                    nullptr,
                    nullptr};
  if (tape.stage_positions.size() > 0) {
    states.xs = tape.stage_positions.col(s).data();
    states.vs = tape.stage_velocities.col(s).data();
  }
  return states;
}

}  // namespace dpe

#endif  // DPE_ENGINE_ROLLOUT_TAPE_H_
