#include "dpe/estimation/autodiff_trajectory_cost.h"

#include <ceres/ceres.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "dpe/engine/simulator.h"
#include "dpe/estimation/trajectory_cost_check.h"
#include "dpe/estimation/trajectory_problem.h"
#include "support/test_scenes.h"

namespace dpe {
namespace {

using ::testing::HasSubstr;
using Quantity = StateRead::Quantity;

constexpr int kFrames = 6;

// Nonlinear in positions of one object and in velocities of another, at two frames.
struct Mixed {
  template <typename T>
  bool operator()(const T* x, const T* v, T* residuals) const {
    residuals[0] = x[0] * x[4] - v[2] * v[2];
    residuals[1] = exp(0.1 * x[5]) * v[1];
    return true;
  }
};

// The same for any number of vertices; counts how often Jets went through it.
struct DynamicMixed {
  template <typename T>
  bool operator()(const T* const* states, T* residuals) const {
    if (!std::is_same<T, double>::value) ++*num_passes;
    return Mixed()(states[0], states[1], residuals);
  }
  int* num_passes;
};

// Positions minus their targets, as PositionCost has it.
struct MinusTarget {
  template <typename T>
  bool operator()(const T* const* states, T* residuals) const {
    for (int i = 0; i < target.size(); ++i) residuals[i] = states[0][i] - target[i];
    return true;
  }
  Eigen::VectorXd target;
};

// Height above a target; after its first evaluation it fails `failures_left` times.
struct HeightAbove {
  template <typename T>
  bool operator()(const T* x, T* residual) const {
    residual[0] = x[1] - target;
    if (!std::is_same<T, double>::value || ++*num_evaluations == 1) return true;
    return --*failures_left < 0;
  }
  double target;
  int* num_evaluations;
  int* failures_left;
};

struct WritesNothing {
  template <typename T>
  bool operator()(const T* /*x*/, T* /*residuals*/) const {
    return true;
  }
};

class AutodiffTrajectoryCostTest : public ::testing::Test {
 protected:
  AutodiffTrajectoryCostTest() {
    ApplySettings("nL,nL", &scene_);
    trajectory_ = Simulator(scene_).Simulate(kFrames);
  }

  std::vector<StateRead> MixedReads() const {
    return {{0, 2, {4, 7}}, {1, 5, {3}, Quantity::kVelocity}};
  }

  Eigen::VectorXd Residuals(const TrajectoryCost& cost) const {
    Eigen::VectorXd residuals(cost.num_residuals());
    EXPECT_TRUE(cost.Evaluate(trajectory_, residuals.data(), nullptr));
    return residuals;
  }

  std::string ErrorOf(std::vector<StateRead> reads) const {
    try {
      MakeAutodiffCost<2, 2, 1>(scene_, Mixed(), std::move(reads));
    } catch (const SceneError& error) {
      return error.what();
    }
    return "";
  }

  Scene scene_ = test::MakeDerivativeScene("two_objects", 4);
  Trajectory trajectory_;
};

// Of a cost that reads one state.
Eigen::MatrixXd PositionJacobian(const TrajectoryCost& cost,
                                 const Trajectory& trajectory) {
  std::vector<StateDerivative> derivatives;
  Eigen::VectorXd residuals(cost.num_residuals());
  EXPECT_TRUE(cost.Evaluate(trajectory, residuals.data(), &derivatives));
  EXPECT_EQ(derivatives.size(), 1u);
  return Eigen::MatrixXd(derivatives[0].d_position);
}

TEST_F(AutodiffTrajectoryCostTest, GivesTheFunctorWhatTheReadsName) {
  const auto cost = MakeAutodiffCost<2, 2, 1>(scene_, Mixed(), MixedReads());
  const auto x4 = trajectory_.positions[0].col(2).segment<3>(3 * 4);
  const auto x7 = trajectory_.positions[0].col(2).segment<3>(3 * 7);
  const auto v3 = trajectory_.velocities[1].col(5).segment<3>(3 * 3);
  const Eigen::VectorXd residuals = Residuals(*cost);
  EXPECT_DOUBLE_EQ(residuals[0], x4[0] * x7[1] - v3[2] * v3[2]);
  EXPECT_DOUBLE_EQ(residuals[1], std::exp(0.1 * x7[2]) * v3[1]);
  ASSERT_EQ(cost->states().size(), 2u);
  EXPECT_EQ(cost->states()[1].object, 1);
  EXPECT_EQ(cost->states()[1].frame, 5);
}

TEST_F(AutodiffTrajectoryCostTest, DerivativesAgreeWithDifferences) {
  const auto fixed = MakeAutodiffCost<2, 2, 1>(scene_, Mixed(), MixedReads());
  const TrajectoryCostCheck check = CheckTrajectoryCost(*fixed, trajectory_, 1e-8);
  EXPECT_TRUE(check.ok) << check.message;
  int num_passes = 0;
  const auto dynamic =
      MakeDynamicAutodiffCost<4>(scene_, DynamicMixed{&num_passes}, MixedReads(), 2);
  const TrajectoryCostCheck second = CheckTrajectoryCost(*dynamic, trajectory_, 1e-8);
  EXPECT_TRUE(second.ok) << second.message;
}

TEST_F(AutodiffTrajectoryCostTest, DerivativesOfOneObjectAtTwoFramesAreKeptApart) {
  const auto cost =
      MakeAutodiffCost<2, 2, 1>(scene_, Mixed(), {{0, 2, {4, 7}}, {0, 4, {4}}});
  const TrajectoryCostCheck check = CheckTrajectoryCost(*cost, trajectory_, 1e-8);
  EXPECT_TRUE(check.ok) << check.message;
}

TEST_F(AutodiffTrajectoryCostTest, EvaluatesAManyVertexFunctorOncePerStride) {
  for (const int num_vertices : {2, 5, 16}) {
    std::vector<int> vertices(num_vertices);
    for (int i = 0; i < num_vertices; ++i) vertices[i] = i;
    int num_passes = 0;
    const auto cost = MakeDynamicAutodiffCost<12>(
        scene_, DynamicMixed{&num_passes},
        {{0, 2, vertices}, {0, 2, {1}, Quantity::kVelocity}}, 2);
    Residuals(*cost);
    EXPECT_EQ(num_passes, 0);
    std::vector<StateDerivative> derivatives;
    Eigen::VectorXd residuals(2);
    ASSERT_TRUE(cost->Evaluate(trajectory_, residuals.data(), &derivatives));
    EXPECT_EQ(num_passes, (3 * (num_vertices + 1) + 11) / 12);
  }
}

TEST_F(AutodiffTrajectoryCostTest, IsThePositionCostWhereItIsWrittenSo) {
  ApplySettings("nL", &scene_);
  Observations target = ObserveAll(trajectory_);
  AddNoise(scene_, 0.1, 1, &target);
  const auto expected = PositionCost::Create(scene_, target, 3);
  StateRead read = {0, 3, {}};
  Eigen::VectorXd observed(expected->num_residuals());
  for (int v = 0; v < scene_.objects[0].num_vertices(); ++v) {
    if (scene_.objects[0].is_fixed[v]) continue;
    observed.segment<3>(3 * read.vertices.size()) =
        target.positions[0].col(3).segment<3>(3 * v);
    read.vertices.push_back(v);
  }
  const auto cost = MakeDynamicAutodiffCost(scene_, MinusTarget{observed}, {read},
                                            static_cast<int>(observed.size()));
  ASSERT_EQ(cost->num_residuals(), expected->num_residuals());
  EXPECT_EQ(Residuals(*cost), Residuals(*expected));
  EXPECT_EQ(PositionJacobian(*cost, trajectory_),
            PositionJacobian(*expected, trajectory_));
  // A selection matrix has one entry per row: nothing that is zero may be stored.
  std::vector<StateDerivative> derivatives;
  ASSERT_TRUE(cost->Evaluate(trajectory_, observed.data(), &derivatives));
  EXPECT_EQ(derivatives[0].d_position.nonZeros(), cost->num_residuals());
}

TEST_F(AutodiffTrajectoryCostTest, ReadsOfOneStateAreOneEntryAndAddUp) {
  // Both arrays of positions name vertex 4.
  const auto cost =
      MakeAutodiffCost<2, 2, 1>(scene_, Mixed(), {{0, 2, {4, 4}}, {0, 2, {4}}});
  ASSERT_EQ(cost->states().size(), 1u);
  EXPECT_EQ(PositionJacobian(*cost, trajectory_).cols(),
            trajectory_.positions[0].rows());
  const TrajectoryCostCheck check = CheckTrajectoryCost(*cost, trajectory_, 1e-8);
  EXPECT_TRUE(check.ok) << check.message;
}

TEST_F(AutodiffTrajectoryCostTest, TakesAnyCeresCostFunction) {
  using Numeric = ceres::NumericDiffCostFunction<Mixed, ceres::CENTRAL, 2, 6, 3>;
  const auto numeric = CeresTrajectoryCost::Create(
      scene_, std::make_unique<Numeric>(new Mixed()), MixedReads());
  const auto exact = MakeAutodiffCost<2, 2, 1>(scene_, Mixed(), MixedReads());
  EXPECT_EQ(Residuals(*numeric), Residuals(*exact));
  const TrajectoryCostCheck check = CheckTrajectoryCost(*numeric, trajectory_, 1e-5);
  EXPECT_TRUE(check.ok) << check.message;
}

TEST_F(AutodiffTrajectoryCostTest, WrongSizesAreErrorsThatSayWhere) {
  EXPECT_EQ(ErrorOf(MixedReads()), "");
  EXPECT_THAT(ErrorOf({{0, 2, {4, 7}}}), HasSubstr("takes 2 arrays of states, but 1"));
  EXPECT_THAT(ErrorOf({{0, 2, {4, 7, 8}}, {0, 2, {1}}}),
              HasSubstr("read 0 has 3 vertices and gives 9 numbers, but the residual "
                        "takes 6"));
  EXPECT_THAT(ErrorOf({{0, 2, {4, 7}}, {0, 2, {}}}), HasSubstr("read 1 names no vert"));
  EXPECT_THAT(ErrorOf({{0, 2, {4, 7}}, {2, 2, {1}}}),
              HasSubstr("read 1 names object 2; accepted are 0 to 1"));
  EXPECT_THAT(ErrorOf({{0, -1, {4, 7}}, {0, 2, {1}}}),
              HasSubstr("read 0 names frame -1"));
  EXPECT_THAT(ErrorOf({{0, 2, {4, 16}}, {0, 2, {1}}}),
              HasSubstr("read 0 names vertex 16 of object 0; accepted are 0 to 15"));
  EXPECT_THAT(ErrorOf({{0, 2, {-1, 1}}, {0, 2, {1}}}), HasSubstr("vertex -1"));
  int unused = 0;
  EXPECT_THROW(MakeDynamicAutodiffCost(scene_, DynamicMixed{&unused}, MixedReads(), 0),
               SceneError);
}

TEST_F(AutodiffTrajectoryCostTest, RefusesOtherVectorInstructionsThanTheLibrarys) {
  using Function = ceres::AutoDiffCostFunction<Mixed, 2, 6, 3>;
  EXPECT_THROW(CeresTrajectoryCost::Create<2 * EIGEN_MAX_ALIGN_BYTES>(
                   scene_, std::make_unique<Function>(new Mixed()), MixedReads()),
               SceneError);
}

TEST_F(AutodiffTrajectoryCostTest, ValuesThatAreNotWrittenAreNotFinite) {
  const auto cost = MakeAutodiffCost<2, 1>(scene_, WritesNothing(), {{0, 1, {4}}});
  EXPECT_TRUE(Residuals(*cost).array().isNaN().all());
  TrajectoryCosts costs;
  costs.push_back(MakeAutodiffCost<2, 1>(scene_, WritesNothing(), {{0, 1, {4}}}));
  TrajectoryEvaluator evaluator(scene_, std::move(costs));
  EXPECT_FALSE(evaluator.Evaluate(
      evaluator.map().ToCoordinates(evaluator.layout().Extract(scene_))));
  EXPECT_THAT(evaluator.message(), HasSubstr("not a finite number"));
}

TEST(AutodiffTrajectoryCostFitTest, AStepOnWhichTheFunctorFailsIsRejected) {
  Scene scene = test::MakeDerivativeScene("side", 4);
  ApplySettings("nG", &scene);
  scene.objects[0].stiffness.setConstant(30.0);
  constexpr int kLast = 60;
  const Trajectory truth = Simulator(scene).Simulate(kLast + 1);
  constexpr int kVertex = 0;
  ASSERT_FALSE(scene.objects[0].is_fixed[kVertex]);
  int num_evaluations = 0, failures_left = 3;
  TrajectoryCosts costs;
  costs.push_back(
      MakeAutodiffCost<1, 1>(scene,
                             HeightAbove{truth.positions[0](3 * kVertex + 1, kLast),
                                         &num_evaluations, &failures_left},
                             {{0, kLast, {kVertex}}}));
  TrajectoryProblem problem(scene, std::move(costs));
  problem.set_coordinates(Eigen::VectorXd::Constant(1, std::log(30.0 * 20.0)));
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_QR;
  options.logging_type = ceres::SILENT;
  options.max_num_consecutive_invalid_steps = 60;
  options.function_tolerance = options.parameter_tolerance = 1e-14;
  options.gradient_tolerance = 1e-18;
  ceres::Solver::Summary summary;
  ceres::Solve(options, problem.least_squares(), &summary);
  EXPECT_LT(failures_left, 0);
  EXPECT_EQ(summary.num_unsuccessful_steps, 3);
  EXPECT_TRUE(summary.IsSolutionUsable()) << summary.message;
  EXPECT_NEAR(std::exp(problem.coordinates()[0]), 30.0, 1e-6);
}

}  // namespace
}  // namespace dpe
