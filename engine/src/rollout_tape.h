// What a rollout keeps for its derivative passes beside the trajectory: states between
// frames and factorised step matrices, as many as the memory limit allows
// (memory_plan.h). What is not kept, passes make again.
#ifndef DPE_ENGINE_ROLLOUT_TAPE_H_
#define DPE_ENGINE_ROLLOUT_TAPE_H_

#include <cstddef>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

#include "inner_states.h"
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

  // Of the first frames.
  InnerStates inner;
  // solvers[s] is the solver of step s as the step left it, of the first steps.
  std::vector<std::unique_ptr<StepSolver>> solvers;
  std::size_t bytes_per_solver = 0;
  std::shared_ptr<SolverPool> pool;
};

class RolloutTape {
 public:
  std::vector<ObjectTape> objects;

  std::size_t bytes() const {
    std::size_t sum = 0;
    for (const ObjectTape& tape : objects) {
      sum += tape.inner.bytes() + tape.solvers.size() * tape.bytes_per_solver;
    }
    return sum;
  }
};

}  // namespace dpe

#endif  // DPE_ENGINE_ROLLOUT_TAPE_H_
