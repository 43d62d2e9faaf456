// The Krylov method: it reaches the tolerance that is asked for, says so where it
// cannot, and its iterations do not grow with the cloth.
#include "linear/iterative_solver.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "dpe/engine/cloth_builder.h"
#include "dpe/engine/simulator.h"
#include "engine/matrix_support.h"
#include "object_system.h"
#include "support/derivative_checker.h"

namespace dpe::test {
namespace {

double RelativeResidual(const BlockPattern& pattern, const std::vector<double>& values,
                        bool transposed, const Eigen::VectorXd& b,
                        const Eigen::VectorXd& z) {
  Eigen::VectorXd product(b.size());
  if (transposed) {
    pattern.MultiplyTransposed(values.data(), z.data(), product.data());
  } else {
    pattern.Multiply(values.data(), z.data(), product.data());
  }
  return (product - b).norm() / b.norm();
}

class IterativeSolverTest : public testing::TestWithParam<double> {};

TEST_P(IterativeSolverTest, ReachesTheToleranceThatIsAskedFor) {
  const std::vector<BlockPattern> patterns = {
      BlockPattern(1, {}), BlockPattern(30, {{0, 1}, {1, 2}, {5, 9}, {20, 25}}),
      RingPattern(40), GridPattern(17, 19)};
  for (const BlockPattern& pattern : patterns) {
    std::vector<double> values(pattern.num_nonzeros());
    IterativeSolver solver(pattern);
    for (const double skew : {0.0, 0.3}) {
      Fill(pattern, skew, 30.0, &values);
      const Eigen::VectorXd b = RandomVector(pattern.num_rows(), 1);
      for (const bool transposed : {false, true}) {
        ASSERT_TRUE(solver.Prepare(values, transposed));
        Eigen::VectorXd z = Eigen::VectorXd::Zero(b.size());
        EXPECT_TRUE(solver.Solve(GetParam(), b.data(), z.data()).converged);
        EXPECT_LE(RelativeResidual(pattern, values, transposed, b, z),
                  1.01 * GetParam());
        // From the solution there is nothing left to do.
        EXPECT_LE(solver.Solve(GetParam(), b.data(), z.data()).iterations, 1);
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Tolerances, IterativeSolverTest,
                         testing::Values(1e-3, 1e-6, 1e-12));

TEST(IterativeSolverTest, ReportsWhatItCannotSolve) {
  const BlockPattern pattern = GridPattern(6, 6);
  std::vector<double> values(pattern.num_nonzeros());
  const Eigen::VectorXd b = RandomVector(pattern.num_rows(), 1);
  IterativeSolver solver(pattern);
  Eigen::VectorXd z = Eigen::VectorXd::Zero(b.size());
  EXPECT_FALSE(solver.Prepare(values, false) &&
               solver.Solve(1e-6, b.data(), z.data()).converged);  // all zeros
  Fill(pattern, 0.3, 30.0, &values);
  values[pattern.Find(20, 20).offset] = std::nan("");
  EXPECT_FALSE(solver.Prepare(values, false) &&
               solver.Solve(1e-6, b.data(), z.data()).converged);
  Fill(pattern, 0.3, 30.0, &values);
  z.setZero();
  EXPECT_TRUE(solver.Prepare(values, false) &&
              solver.Solve(1e-6, b.data(), z.data()).converged);
}

// Iterations for a step matrix of the preset side, a few steps after the start.
int IterationsOnSide(int size, bool uneven) {
  PresetOptions options;
  options.rows = options.cols = size;
  Scene scene = MakePresetScene(ScenePreset::kSide, options);
  if (uneven) {  // by a factor of 1000
    const Eigen::VectorXd factors =
        RandomVector(scene.objects[0].num_springs(), 2).array().tanh() * std::log(31.6);
    scene.objects[0].stiffness.array() *= factors.array().exp();
  }
  Simulator simulator(scene);
  const Trajectory trajectory = simulator.Simulate(4);
  EXPECT_TRUE(trajectory.status.ok()) << trajectory.status.Message();
  ObjectSystem system(scene, 0, simulator.layout());
  const Eigen::VectorXd x = trajectory.positions[0].col(3);
  const Eigen::VectorXd v = trajectory.velocities[0].col(3);
  std::vector<double> values;
  system.AssembleStepMatrix(x.data(), v.data(), scene.step_length(), &values);
  IterativeSolver solver(system.pattern());
  EXPECT_TRUE(solver.Prepare(values, false));
  const Eigen::VectorXd b = RandomVector(system.pattern().num_rows(), 1);
  Eigen::VectorXd z = Eigen::VectorXd::Zero(b.size());
  const IterativeResult result = solver.Solve(1e-8, b.data(), z.data());
  EXPECT_TRUE(result.converged);
  EXPECT_LE(RelativeResidual(system.pattern(), values, false, b, z), 1.01e-8);
  return result.iterations;
}

TEST(IterativeSolverTest, IterationsHardlyGrowWithTheCloth) {
  const int coarse = IterationsOnSide(12, false);
  const int fine = IterationsOnSide(64, false);
  EXPECT_LE(fine, 2 * coarse) << coarse;
  // Stiffnesses that jump by factors of up to 1000 cost more, but bounded many.
  EXPECT_LE(IterationsOnSide(48, true), 8 * coarse);
}

}  // namespace
}  // namespace dpe::test
