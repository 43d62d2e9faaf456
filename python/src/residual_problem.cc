// dpe.ResidualProblem: costs as a function of the optimiser's coordinates.
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <limits>
#include <memory>
#include <mutex>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "arrays.h"
#include "dpe/estimation/priors.h"
#include "dpe/estimation/trajectory_evaluator.h"
#include "errors.h"
#include "long_call.h"
#include "module.h"
#include "python_cost.h"
#include "simulation.h"
#include "trajectory.h"

namespace py = pybind11;

namespace dpe::python {
namespace {

class ResidualProblem {
 public:
  ResidualProblem(const Scene& scene, const std::vector<PyCost>& costs, int threads,
                  double memory_limit, const std::string& prior,
                  const std::string& smoothness)
      : scene_(std::make_shared<Scene>(scene)) {
    if (costs.empty()) throw py::value_error("costs: there are none");
    TrajectoryCosts shared;
    for (const PyCost& cost : costs) {
      costs_.push_back(cost.cost);
      shared.push_back(std::make_unique<SharedCost>(cost.cost));
    }
    const SimulatorOptions limits = MakeSimulatorOptions(threads, memory_limit);
    TrajectoryEvaluatorOptions options;
    options.num_threads = limits.num_threads;
    options.memory_limit_bytes = limits.memory_limit_bytes;
    options.priors = PriorsFromText(prior);
    options.smoothness = SmoothnessFromText(smoothness);
    options.interrupted = [this] {
      return interrupts_ != nullptr && interrupts_->Poll();
    };
    evaluator_ =
        std::make_unique<TrajectoryEvaluator>(scene, std::move(shared), options);
  }

  py::array Residuals(const py::object& q) {
    const Eigen::VectorXd coordinates = Coordinates(q);
    return ToArray(Call([&] {
      if (evaluator_->Evaluate(coordinates)) return evaluator_->residuals();
      return Infinite(evaluator_->num_residuals());
    }));
  }

  double Cost(const py::object& q) {
    const Eigen::VectorXd coordinates = Coordinates(q);
    return Call([&] {
      return evaluator_->Evaluate(coordinates)
                 ? evaluator_->cost()
                 : std::numeric_limits<double>::infinity();
    });
  }

  py::array Jacobian(const py::object& q) {
    const Eigen::VectorXd coordinates = Coordinates(q);
    bool ok = false;
    const auto jacobian =
        std::make_shared<RowMajorMatrix>(Call([&]() -> RowMajorMatrix {
          ok = evaluator_->Evaluate(coordinates) && evaluator_->EvaluateJacobian();
          return ok ? evaluator_->DenseJacobian() : RowMajorMatrix();
        }));
    RequireDerivatives(ok);
    return ViewOf(jacobian->data(), {jacobian->rows(), jacobian->cols()}, jacobian,
                  /*is_writable=*/true);
  }

  py::array Gradient(const py::object& q) {
    const Eigen::VectorXd coordinates = Coordinates(q);
    bool ok = false;
    Eigen::VectorXd gradient = Call([&] {
      Eigen::VectorXd result;
      ok = evaluator_->Evaluate(coordinates) && evaluator_->EvaluateGradient(&result);
      return result;
    });
    RequireDerivatives(ok);
    return ToArray(std::move(gradient));
  }

  py::array Start() const {
    return ToArray(
        evaluator_->map().ToCoordinates(evaluator_->layout().Extract(*scene_)));
  }
  py::array ToParameters(const py::object& q) const {
    return ToArray(evaluator_->map().ToParameters(Coordinates(q)));
  }
  py::array ToCoordinates(const py::object& p) const {
    return ToArray(evaluator_->map().ToCoordinates(
        VectorFromArray(p, "parameters", evaluator_->num_parameters())));
  }
  std::shared_ptr<Scene> SceneAt(const py::object& q) const {
    auto scene = std::make_shared<Scene>(*scene_);
    evaluator_->layout().Insert(evaluator_->map().ToParameters(Coordinates(q)),
                                scene.get());
    return scene;
  }
  int num_residuals() const { return evaluator_->num_residuals(); }
  int num_parameters() const { return evaluator_->num_parameters(); }
  int num_rollouts() const { return evaluator_->num_rollouts(); }
  std::string message() const { return evaluator_->ok() ? "" : evaluator_->message(); }
  std::vector<ParameterBlock> blocks() const { return evaluator_->layout().blocks(); }

 private:
  static Eigen::VectorXd Infinite(int size) {
    return Eigen::VectorXd::Constant(size, std::numeric_limits<double>::infinity());
  }

  Eigen::VectorXd Coordinates(const py::object& q) const {
    return VectorFromArray(q, "coordinates", evaluator_->num_parameters());
  }

  void RequireDerivatives(bool ok) const {
    if (ok) return;
    RaiseSimulationError(evaluator_->ok()
                             ? "the derivative pass failed or is not finite"
                             : evaluator_->message(),
                         py::none());
  }

  template <class Work>
  std::invoke_result_t<Work> Call(const Work& work) {
    Interrupts interrupts;
    auto result = CallLong(&interrupts, [&] {
      const std::lock_guard<std::mutex> lock(mutex_);
      interrupts_ = &interrupts;
      auto value = work();
      interrupts_ = nullptr;
      return value;
    });
    RethrowErrors(costs_);
    return result;
  }

  std::shared_ptr<const Scene> scene_;
  std::vector<CostPointer> costs_;
  std::mutex mutex_;
  Interrupts* interrupts_ = nullptr;
  std::unique_ptr<TrajectoryEvaluator> evaluator_;
};

}  // namespace

void BindResidualProblem(py::module_& m) {
  using P = ResidualProblem;
  py::class_<P>(
      m, "ResidualProblem",
      "Costs on the motion of a scene as a function of coordinates q, one per unknown: "
      "the logarithm of positive quantities (mass, stiffness, damping, drag), the "
      "value "
      "of others. Made for scipy.optimize: least_squares(problem.residuals, "
      "problem.start, problem.jacobian), or minimize(problem.cost, problem.start, "
      "jac=problem.gradient). A rollout per new q, however often it is asked for. "
      "prior, "
      "smoothness: as for estimate; they count in cost and gradient only.")
      .def(py::init<const Scene&, const std::vector<PyCost>&, int, double,
                    const std::string&, const std::string&>(),
           py::arg("scene"), py::arg("costs"), py::kw_only(), py::arg("threads") = 1,
           py::arg("memory_limit") = 2048.0, py::arg("prior") = "",
           py::arg("smoothness") = "")
      .def("residuals", &P::Residuals, py::arg("q"),
           "Of all costs, shape (residuals,). Infinite where the motion cannot be "
           "simulated: scipy's least_squares then takes a shorter step.")
      .def("jacobian", &P::Jacobian, py::arg("q"),
           "dr/dq, shape (residuals, parameters). Raises SimulationError.")
      .def("cost", &P::Cost, py::arg("q"),
           "1/2 sum of squared residuals and priors; infinite where the motion cannot "
           "be "
           "simulated.")
      .def("gradient", &P::Gradient, py::arg("q"),
           "d cost/dq, shape (parameters,), by one adjoint pass. Raises "
           "SimulationError.")
      .def_property_readonly("start", &P::Start,
                             "The q of the scene's own values, shape (parameters,).")
      .def("parameters", &P::ToParameters, py::arg("q"),
           "SI units, shape (parameters,).")
      .def("coordinates", &P::ToCoordinates, py::arg("parameters"),
           "q, shape (parameters,).")
      .def("scene", &P::SceneAt, py::arg("q"), "The scene with these values.")
      .def_property_readonly("parameter_blocks", &P::blocks,
                             "What the unknowns are, in order.")
      .def_property_readonly("num_residuals", &P::num_residuals, "Of all costs.")
      .def_property_readonly("num_parameters", &P::num_parameters, "Unknowns.")
      .def_property_readonly("num_rollouts", &P::num_rollouts, "Simulations so far.")
      .def_property_readonly("message", &P::message,
                             "Why the last point could not be evaluated; empty if it "
                             "could.");
}

}  // namespace dpe::python
