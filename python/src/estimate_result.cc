#include "estimate_result.h"

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <cmath>
#include <filesystem>
#include <limits>
#include <sstream>
#include <string>

#include "arrays.h"
#include "dpe/estimation/report_io.h"
#include "long_call.h"
#include "trajectory.h"

namespace py = pybind11;

namespace dpe::python {
namespace {

using ResultClass = py::class_<EstimateResult, ResultPointer>;

PyTrajectory TrajectoryOf(const ResultPointer& result, size_t capture) {
  const Trajectory& trajectory = result->validations()[capture].trajectory;
  return {{result, &trajectory}, {result, &result->summary.captures[capture].scene}};
}

std::vector<PyTrajectory> Trajectories(const ResultPointer& result) {
  std::vector<PyTrajectory> trajectories;
  for (size_t c = 0; c < result->input.captures.size(); ++c) {
    trajectories.push_back(TrajectoryOf(result, c));
  }
  return trajectories;
}

std::vector<std::shared_ptr<Scene>> Scenes(const EstimateResult& result) {
  std::vector<std::shared_ptr<Scene>> scenes;
  for (const CaptureSummary& capture : result.summary.captures) {
    scenes.push_back(std::make_shared<Scene>(capture.scene));
  }
  return scenes;
}

py::object Deviation(const EstimateResult& result) {
  if (!result.input.truth_is_known) return py::none();
  const double percent =
      ParameterDeviationPercent(result.summary, result.input.scenes());
  if (std::isnan(percent)) return py::none();
  return py::float_(percent);
}

// In the order of the parameter vector; NaN where there are no error bars.
py::array StandardDeviations(const EstimateResult& result) {
  Eigen::VectorXd all = Eigen::VectorXd::Constant(
      result.summary.parameters.size(), std::numeric_limits<double>::quiet_NaN());
  Eigen::Index offset = 0;
  for (const BlockUncertainty& block : result.summary.uncertainty.blocks) {
    const Eigen::Index size = block.standard_deviations.size();
    if (offset + size > all.size()) break;
    all.segment(offset, size) = block.standard_deviations;
    offset += size;
  }
  return ToArray(std::move(all));
}

const ModelSelection* SelectionOf(const EstimateResult& result) {
  return result.input.auto_objects.empty() ? nullptr : &result.selection;
}

std::vector<std::string> Save(EstimateResult& result,
                              const std::filesystem::path& folder,
                              const std::string& format) {
  EstimationJob job = result.job;
  job.output_dir = folder.string();
  job.trajectory_format = TrajectoryFormatFromName(format);
  const std::vector<Validation>& validations = result.validations();
  const std::string prepared = PrepareOutputDir(job, result.input);
  return WriteResults(job, result.input, result.summary, validations, prepared,
                      SelectionOf(result));
}

py::object Report(EstimateResult& result) {
  const std::string text = ReportToJson(result.job, result.input, result.summary,
                                        result.validations(), SelectionOf(result));
  return py::module_::import("json").attr("loads")(text);
}

std::string Repr(const EstimateResult& result) {
  std::ostringstream text;
  text << "<dpe.Estimate: " << TerminationName(result.summary.termination) << ", "
       << result.summary.parameters.size() << " parameters, RMS "
       << result.summary.final_rms << " m>";
  return text.str();
}

void BindIteration(py::module_& m) {
  using Report = IterationReport;
  py::class_<Report>(m, "Iteration", "How far a fit had got after an iteration.")
      .def_readonly("iteration", &Report::iteration, "Number, from 0: the start.")
      .def_readonly("frames", &Report::num_frames, "Of the horizon being fitted.")
      .def_readonly("cost", &Report::cost, "1/2 sum of squared residuals.")
      .def_readonly("rms", &Report::rms, "m, of the best point so far.")
      .def_readonly("step_norm", &Report::step_norm,
                    "In the optimiser's (logarithmic) coordinates.")
      .def_readonly("gradient_max_norm", &Report::gradient_max_norm,
                    "Of the cost in these coordinates.")
      .def_readonly("seconds", &Report::seconds, "Since the start.")
      .def_readonly("step_accepted", &Report::step_accepted,
                    "Whether the step was taken.")
      .def("__repr__", [](const Report& r) {
        std::ostringstream text;
        text << "<dpe.Iteration " << r.iteration << ": cost " << r.cost << ", RMS "
             << r.rms << " m>";
        return text.str();
      });
}

void BindBlock(py::module_& m) {
  using Block = EstimatedBlock;
  py::class_<Block>(m, "EstimatedBlock", "The estimated values of one kind.")
      .def_readonly("object", &Block::object,
                    "Index of the cloth; -1: the scene's own.")
      .def_readonly("capture", &Block::capture,
                    "Whose alone it is, from 0; -1: all captures'.")
      .def_readonly("kind", &Block::kind, "\"mass\", \"stiffness\", ...")
      .def_property_readonly(
          "mode", [](const Block& b) { return std::string(1, b.mode); },
          "\"G\", \"R\" or \"L\".")
      .def_readonly("unit", &Block::unit, "Of the values.")
      .def_property_readonly(
          "values", [](const Block& b) { return ToArray(b.values); },
          "SI units, shape (n,).")
      .def_readonly("elements", &Block::elements,
                    "Mode L: the vertex or spring of each value.")
      .def_readonly("inactive", &Block::inactive,
                    "Elements without influence on the motion.");
}

void BindOutcome(ResultClass* type) {
  type->def_property_readonly(
          "converged", [](const EstimateResult& r) { return r.summary.usable(); },
          "Whether the result is usable.")
      .def_property_readonly(
          "termination",
          [](const EstimateResult& r) {
            return TerminationName(r.summary.termination);
          },
          "\"converged\", \"max_iterations\", \"max_seconds\", \"interrupted\", ...")
      .def_property_readonly(
          "message", [](const EstimateResult& r) { return r.summary.message; },
          "Why it stopped, one sentence.")
      .def_property_readonly(
          "notes", [](const EstimateResult& r) { return r.summary.notes; },
          "Gauges fixed, values clamped, ...")
      .def_property_readonly(
          "solver", [](const EstimateResult& r) { return r.summary.solver; },
          "\"lm\" or \"lbfgs\".")
      .def_property_readonly(
          "init", [](const EstimateResult& r) { return r.summary.init; },
          "The method that gave the start.")
      .def_property_readonly(
          "iterations", [](const EstimateResult& r) { return r.summary.iterations; },
          "Of the optimiser.")
      .def_property_readonly(
          "evaluations", [](const EstimateResult& r) { return r.summary.evaluations; },
          "Rollouts.")
      .def_property_readonly(
          "seconds", [](const EstimateResult& r) { return r.summary.wall_time_s; },
          "Of wall time.")
      .def_property_readonly(
          "initial_cost",
          [](const EstimateResult& r) { return r.summary.initial_cost; },
          "1/2 sum of squared residuals at the start.")
      .def_property_readonly(
          "cost", [](const EstimateResult& r) { return r.summary.final_cost; },
          "1/2 sum of squared residuals.")
      .def_property_readonly(
          "initial_rms", [](const EstimateResult& r) { return r.summary.initial_rms; },
          "Position error at the start, m.")
      .def_property_readonly(
          "rms", [](const EstimateResult& r) { return r.summary.final_rms; },
          "Position error, m.")
      .def_property_readonly(
          "frames", [](const EstimateResult& r) { return r.summary.num_frames; },
          "Fitted, of the longest capture.")
      .def_readonly("history", &EstimateResult::history,
                    "An Iteration for each iteration.");
}

void BindValues(ResultClass* type) {
  type->def_property_readonly(
          "parameters",
          [](const EstimateResult& r) { return ToArray(r.summary.parameters); },
          "In the order of blocks, SI units, shape (parameters,).")
      .def_property_readonly("standard_deviations", &StandardDeviations,
                             "Error bars of parameters, SI units, shape (parameters,); "
                             "infinite: undetermined, NaN: not computed.")
      .def_property_readonly(
          "covariance",
          [](const EstimateResult& r) {
            return ToArray(r.summary.uncertainty.covariance);
          },
          "Of the optimiser's coordinates (logarithms of positive quantities), shape "
          "(parameters, parameters); (0, 0) if there is none.")
      .def_property_readonly(
          "uncertainty", [](const EstimateResult& r) { return r.summary.uncertainty; },
          "Error bars, and what was not determined.")
      .def_property_readonly(
          "blocks", [](const EstimateResult& r) { return r.summary.blocks; },
          "The values by kind.")
      .def_property_readonly(
          "settings",
          [](const EstimateResult& r) { return SettingsString(r.summary.scene); },
          "What was estimated: those asked for, or chosen.")
      .def_property_readonly("parameter_deviation_percent", &Deviation,
                             "From the scene's values, if these made the target and "
                             "the settings can express them; else None.");
}

void BindOutputs(ResultClass* type) {
  type->def_property_readonly(
          "scene",
          [](const EstimateResult& r) {
            return std::make_shared<Scene>(r.summary.scene);
          },
          "The (first) scene with the estimated values. A copy.")
      .def_property_readonly("scenes", &Scenes, "Of every capture, likewise.")
      .def_property_readonly(
          "trajectory", [](const ResultPointer& r) { return TrajectoryOf(r, 0); },
          "The fitted motion, of the first capture; simulated when first asked for.")
      .def_property_readonly("trajectories", &Trajectories, "Of every capture.")
      .def_property_readonly(
          "validation_rms",
          [](EstimateResult& r) { return Together(r.validations()).rms; },
          "Position error over validate_frames, m; NaN without.")
      .def_property_readonly(
          "held_out_rms",
          [](EstimateResult& r) { return Together(r.validations()).held_out_rms; },
          "Position error over those of them that were not fitted, m; NaN without.")
      .def("report", &Report, "What estimate_cloth writes into report.json.")
      .def(
          "save", &Save, py::arg("folder"), py::arg("trajectory_format") = "csv",
          "Writes what estimate_cloth writes: the scene with the estimated values, the "
          "fitted motion, the report. Returns the files.")
      .def("__repr__", &Repr);
}

}  // namespace

const std::vector<Validation>& EstimateResult::validations() {
  if (validations_ == nullptr) {
    Interrupts interrupts;
    auto found = CallLong(
        &interrupts, [&] { return Validate(summary, input, job.options.num_threads); });
    // Another Python thread may have been faster; what it handed out stays.
    if (validations_ == nullptr) {
      validations_ = std::make_unique<std::vector<Validation>>(std::move(found));
    }
  }
  return *validations_;
}

void BindEstimateResult(py::module_& m) {
  BindIteration(m);
  BindBlock(m);
  ResultClass type(m, "Estimate", "What an estimation found. SI units.");
  BindOutcome(&type);
  BindValues(&type);
  BindOutputs(&type);
}

}  // namespace dpe::python
