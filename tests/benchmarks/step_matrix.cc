#include "step_matrix.h"

#include "dpe/engine/parameters.h"
#include "dpe/engine/simulator.h"
#include "object_system.h"  // private to the engine: see CMakeLists.txt

namespace dpe::bench {

SymmetricMatrix StepMatrix(Case c) {
  c.method = IntegrationMethod::kLinearlyImplicitEuler;
  c.solver = "auto";
  const Scene scene = MakeScene(c);
  Simulator simulator(scene);
  const int frame = (c.plan.num_frames - 1) / 2;
  const Trajectory trajectory = simulator.Simulate(frame + 1);
  SymmetricMatrix matrix;
  if (!trajectory.status.ok()) return matrix;
  const Eigen::VectorXd x = trajectory.positions[0].col(frame);
  const Eigen::VectorXd v = trajectory.velocities[0].col(frame);

  const ObjectSystem system(scene, 0, ParameterLayout(scene));
  const BlockPattern& pattern = system.pattern();
  std::vector<double> values;
  system.AssembleStepMatrix(x.data(), v.data(), scene.step_length(), &values);
  matrix.column_starts = pattern.column_starts();
  matrix.row_indices = pattern.row_indices();
  matrix.values.resize(values.size());
  for (size_t k = 0; k < values.size(); ++k) {
    matrix.values[k] = 0.5 * (values[k] + values[pattern.transposed_index()[k]]);
  }
  return matrix;
}

}  // namespace dpe::bench
