// What an estimation from Python leaves behind.
#ifndef DPE_PYTHON_ESTIMATE_RESULT_H_
#define DPE_PYTHON_ESTIMATE_RESULT_H_

#include <pybind11/pybind11.h>

#include <memory>
#include <vector>

#include "dpe/estimation/estimation_job.h"
#include "dpe/estimation/estimator.h"
#include "dpe/estimation/model_selection.h"

namespace dpe::python {

class EstimateResult {
 public:
  EstimationJob job;  // without callbacks
  EstimationInput input;
  EstimatorSummary summary;
  ModelSelection selection;  // if settings were to be chosen
  std::vector<IterationReport> history;

  // The fitted motions, and how they compare with what was observed: simulated when
  // first asked for, since who stops a fit does not want to wait.
  const std::vector<Validation>& validations();

 private:
  std::unique_ptr<std::vector<Validation>> validations_;
};

using ResultPointer = std::shared_ptr<EstimateResult>;

void BindEstimateResult(pybind11::module_& m);

}  // namespace dpe::python

#endif  // DPE_PYTHON_ESTIMATE_RESULT_H_
