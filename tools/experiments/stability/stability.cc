#include "experiments/stability/stability.h"

#include <cstdio>

#include "experiments/stability/energy_history.h"
#include "experiments/stability/stability_cell.h"
#include "experiments/stability/stability_report.h"
#include "experiments/stability/stability_scene.h"

namespace dpe::experiments {
namespace {

constexpr int kMethods = 5;
constexpr int kFirstImplicit = 2;

IntegrationMethod MethodOf(const Job& job) {
  return IntegrationMethodFromName(std::to_string(job.Integer("integrator", -1)));
}

Job CellJob(const StabilityAxis& axis, double value, int method,
            const std::string& solver) {
  char number[32];
  std::snprintf(number, sizeof(number), "%g", value);
  Job job;
  job.Set("id", "stability." + axis.name + "=" + number + "." + std::to_string(method) +
                    "." + solver);
  job.Set("kind", "stability");
  job.Set("axis", axis.name);
  job.Set("value", value);
  job.Set("integrator", method);
  job.Set("solver", solver);
  return job;
}

}  // namespace

std::vector<Job> StabilityJobs(const std::string& axis_name) {
  std::vector<Job> jobs;
  for (const StabilityAxis& axis : StabilityAxes()) {
    if (!axis_name.empty() && axis.name != axis_name) continue;
    for (double value : axis.values) {
      for (int method = 0; method < kMethods; ++method) {
        jobs.push_back(CellJob(axis, value, method, "cholesky"));
        if (method >= kFirstImplicit) {
          jobs.push_back(CellJob(axis, value, method, "cg"));
        }
      }
    }
  }
  return jobs;
}

JobKind StabilityJobKind() {
  return {"stability", "one integrator and solver at one value of one axis",
          [](const Job& job) {
            StabilityCell cell;
            cell.axis = job.Text("axis", "");
            cell.value = job.Number("value", 0.0);
            cell.method = MethodOf(job);
            cell.solver = job.Text("solver", "cholesky");
            return RunStabilityCell(cell);
          }};
}

JobKind EnergyJobKind() {
  return {"energy", "energy and momenta of an undamped free cloth",
          [](const Job& job) { return EnergyHistory(MethodOf(job)); }};
}

Experiment StabilityExperiment() {
  Experiment experiment;
  experiment.name = "stability";
  experiment.summary = "every integrator and solver at the extremes of every quantity";
  experiment.title = "Where each integrator can be trusted";
  experiment.jobs = [] {
    std::vector<Job> jobs = StabilityJobs();
    for (int method = 0; method < kMethods; ++method) {
      Job job;
      job.Set("id", "energy." + std::to_string(method));
      job.Set("kind", "energy");
      job.Set("integrator", method);
      jobs.push_back(job);
    }
    return jobs;
  };
  experiment.results = StabilityResults;
  return experiment;
}

}  // namespace dpe::experiments
