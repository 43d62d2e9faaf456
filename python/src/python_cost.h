// Residuals on simulated states that are written in Python.
#ifndef DPE_PYTHON_PYTHON_COST_H_
#define DPE_PYTHON_PYTHON_COST_H_

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <memory>
#include <mutex>
#include <vector>

#include "dpe/estimation/trajectory_cost.h"

namespace dpe::python {

// Calls a Python function, from whatever thread the engine evaluates costs in; it takes
// the GIL for that. What the function raises is kept, the evaluation fails, and who
// asked for it throws it (RethrowErrors).
class PythonCost : public TrajectoryCost {
 public:
  PythonCost(int num_residuals, std::vector<StateReference> states,
             pybind11::function function)
      : TrajectoryCost(num_residuals, std::move(states)),
        function_(std::move(function)) {}
  // With the GIL, as every owner of one is a Python object.
  ~PythonCost() override = default;

  bool Evaluate(const Trajectory& trajectory, double* residuals,
                std::vector<StateDerivative>* derivatives) const override;

  // Throws what the function last raised, once. With the GIL.
  void RethrowError() const;

 private:
  bool Call(const Trajectory& trajectory, double* residuals,
            std::vector<StateDerivative>* derivatives) const;

  pybind11::function function_;
  mutable std::unique_ptr<pybind11::error_already_set> error_;  // under the GIL
};

// One state that a residual reads, as the function sees it.
struct StateView {
  int object = 0;
  int frame = 0;
  pybind11::array positions;
  pybind11::array velocities;
};

// A cost that Python holds; an evaluator, which wants to own its costs, gets a Shared.
using CostPointer = std::shared_ptr<const TrajectoryCost>;

class SharedCost : public TrajectoryCost {
 public:
  explicit SharedCost(CostPointer cost)
      : TrajectoryCost(cost->num_residuals(), cost->states()), cost_(std::move(cost)) {}
  bool Evaluate(const Trajectory& trajectory, double* residuals,
                std::vector<StateDerivative>* derivatives) const override {
    return cost_->Evaluate(trajectory, residuals, derivatives);
  }

 private:
  CostPointer cost_;
};

// What Python sees of any cost.
struct PyCost {
  CostPointer cost;
};

// Throws what a Python function raised in any of these. With the GIL.
void RethrowErrors(const std::vector<CostPointer>& costs);

}  // namespace dpe::python

#endif  // DPE_PYTHON_PYTHON_COST_H_
