// Recovers mass, damping and drag of a flag from one number per frame: the elastic
// energy that is stored in all its springs.
//
// A residual reads states and nothing else, so the stiffnesses in the energy are known
// constants, and the scene does not estimate them. (With unknown stiffnesses the energy
// would have to be a residual on states and parameters.)
//
// Exit code 0: the parameters that made the measurements were recovered.
#include <array>
#include <cstdio>
#include <exception>
#include <memory>
#include <numeric>
#include <utility>
#include <vector>

#include "dpe/engine/cloth_builder.h"
#include "dpe/engine/simulator.h"
#include "dpe/estimation/autodiff_trajectory_cost.h"
#include "example_support.h"

namespace dpe::examples {
namespace {

constexpr int kNumFrames = 60;
constexpr double kSigma = 1e-3;  // J, of a measurement
constexpr double kTolerance = 1e-6;

// [stretch_energy]
// Simulated minus measured energy of all springs at one frame, in standard deviations:
//
//   r = (E - measured) / sigma,       E = 1/2 sum k (l - L)^2,  l = |xa - xb|
//   dE/dxa = k (l - L) (xa - xb) / l  summed over the springs of a
class StretchEnergyCost : public TrajectoryCost {
 public:
  StretchEnergyCost(const ClothObject& cloth, int frame, double measured)
      : TrajectoryCost(/*num_residuals=*/1, {{/*object=*/0, frame}}),
        springs_(cloth.springs),
        stiffness_(cloth.stiffness),
        rest_length_(RestLengths(cloth)),
        measured_(measured) {}

  bool Evaluate(const Trajectory& trajectory, double* residuals,
                std::vector<StateDerivative>* derivatives) const override {
    const int frame = states()[0].frame;
    const auto x = trajectory.positions[0].col(frame);
    double energy = 0.0;
    Eigen::RowVectorXd d_energy = Eigen::RowVectorXd::Zero(x.size());
    for (size_t s = 0; s < springs_.size(); ++s) {
      const auto& [a, b] = springs_[s];
      const Eigen::Vector3d edge = x.segment<3>(3 * a) - x.segment<3>(3 * b);
      const double length = edge.norm();
      if (length == 0.0) return false;  // there is no derivative there
      const double stretch = length - rest_length_[s];
      energy += 0.5 * stiffness_[s] * stretch * stretch;
      const Eigen::Vector3d force = stiffness_[s] * stretch / length * edge;
      d_energy.segment<3>(3 * a) += force;
      d_energy.segment<3>(3 * b) -= force;
    }
    residuals[0] = (energy - measured_) / kSigma;
    if (derivatives == nullptr) return true;
    StateDerivative derivative;
    derivative.object = 0;
    derivative.frame = frame;
    derivative.first_row = 0;
    derivative.d_position = (d_energy / kSigma).sparseView();
    derivatives->push_back(std::move(derivative));
    return true;
  }

 private:
  std::vector<std::array<int, 2>> springs_;
  Eigen::VectorXd stiffness_, rest_length_;  // N/m, m
  double measured_;                          // J
};
// [stretch_energy]

// [stretch_energy_autodiff]
// The same without the derivative. It reads every vertex, so it is evaluated with a few
// derivatives at a time, many times over: once per 4 vertices where the one above needs
// one evaluation.
struct StretchEnergy {
  template <typename T>
  bool operator()(const T* const* states, T* residual) const {
    const T* x = states[0];
    T energy(0.0);
    for (int s = 0; s < cloth->num_springs(); ++s) {
      const auto& [a, b] = cloth->springs[s];
      T squared_length(0.0);
      for (int axis = 0; axis < 3; ++axis) {
        const T difference = x[3 * a + axis] - x[3 * b + axis];
        squared_length += difference * difference;
      }
      if (squared_length == T(0.0)) return false;
      using std::sqrt;
      const T stretch = sqrt(squared_length) - rest_length[s];
      energy += 0.5 * cloth->stiffness[s] * stretch * stretch;
    }
    residual[0] = (energy - measured) / kSigma;
    return true;
  }

  const ClothObject* cloth;
  Eigen::VectorXd rest_length;
  double measured;
};

std::unique_ptr<TrajectoryCost> MakeStretchEnergyByAutodiff(const Scene& scene,
                                                            int frame,
                                                            double measured) {
  const ClothObject& cloth = scene.objects[0];
  std::vector<int> all_vertices(cloth.num_vertices());
  std::iota(all_vertices.begin(), all_vertices.end(), 0);
  return MakeDynamicAutodiffCost</*kStride=*/12>(
      scene, StretchEnergy{&cloth, RestLengths(cloth), measured},
      {{/*object=*/0, frame, all_vertices}}, /*num_residuals=*/1);
}
// [stretch_energy_autodiff]

// What a cost without a measurement measures.
double EnergyAt(const ClothObject& cloth, const Trajectory& trajectory, int frame) {
  double residual = 0.0;
  StretchEnergyCost(cloth, frame, 0.0).Evaluate(trajectory, &residual, nullptr);
  return residual * kSigma;
}

bool Run() {
  PresetOptions preset;
  preset.rows = preset.cols = 8;
  Scene scene = MakePresetScene(ScenePreset::kFlag, preset);
  ApplySettings("Gn", &scene);  // one mass for all vertices; stiffnesses are known
  scene.objects[0].estimate_damping = true;
  scene.objects[0].estimate_drag = true;
  const ParameterLayout layout(scene);
  const Eigen::VectorXd truth = layout.Extract(scene);
  layout.Insert(truth, &scene);  // the same mass at every vertex
  const Trajectory measured = Simulator(scene).Simulate(kNumFrames);
  std::printf("%d springs, %d frames: one energy each\n",
              scene.objects[0].num_springs(), kNumFrames - 1);

  // From here on the scene does not know the true values any more.
  const Eigen::VectorXd start = Eigen::Vector3d(0.2, 0.5, 0.5);  // kg, 1/s, 1
  layout.Insert(start, &scene);

  TrajectoryCosts costs;
  for (int frame = 1; frame < kNumFrames; ++frame) {
    costs.push_back(std::make_unique<StretchEnergyCost>(
        scene.objects[0], frame, EnergyAt(scene.objects[0], measured, frame)));
  }
  const auto by_autodiff = MakeStretchEnergyByAutodiff(scene, kNumFrames - 1, 0.0);
  if (!CheckAndPrint(*costs.back(), measured) ||
      !CheckAndPrint(*by_autodiff, measured)) {
    return false;
  }
  TrajectoryProblem problem(scene, std::move(costs));
  problem.set_coordinates(problem.evaluator()->map().ToCoordinates(start));
  const Eigen::VectorXd found = Minimize(&problem);
  return PrintComparison(layout, truth, start, found, kTolerance);
}

}  // namespace
}  // namespace dpe::examples

int main() {
  try {
    return dpe::examples::Run() ? 0 : 1;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "stretch_energy: error: %s\n", error.what());
    return 1;
  }
}
