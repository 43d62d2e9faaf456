#include <gtest/gtest.h>

#include <limits>

#include "dpe/engine/simulator.h"
#include "dpe/estimation/trajectory_cost.h"
#include "support/derivative_checker.h"
#include "support/test_scenes.h"

namespace dpe {
namespace {

constexpr int kFrame = 3;

class PositionCostTest : public ::testing::Test {
 protected:
  PositionCostTest() {
    ApplySettings("nL,nL", &scene_);
    trajectory_ = Simulator(scene_).Simulate(6);
    target_ = ObserveAll(trajectory_);
    AddNoise(scene_, 0.1, 1, &target_);
  }

  Scene scene_ = test::MakeDerivativeScene("two_objects", 3);
  Trajectory trajectory_;
  Observations target_;
};

TEST_F(PositionCostTest, IsSimulatedMinusObservedOfFreeVertices) {
  const auto cost = PositionCost::Create(scene_, target_, kFrame);
  ASSERT_NE(cost, nullptr);
  Eigen::VectorXd residuals(cost->num_residuals());
  ASSERT_TRUE(cost->Evaluate(trajectory_, residuals.data(), nullptr));
  int row = 0;
  for (int object = 0; object < 2; ++object) {
    for (int v = 0; v < scene_.objects[object].num_vertices(); ++v) {
      if (scene_.objects[object].is_fixed[v]) continue;
      const Eigen::Vector3d expected =
          trajectory_.positions[object].col(kFrame).segment<3>(3 * v) -
          target_.positions[object].col(kFrame).segment<3>(3 * v);
      EXPECT_EQ((residuals.segment<3>(row)), expected);
      row += 3;
    }
  }
  EXPECT_EQ(row, cost->num_residuals());
}

TEST_F(PositionCostTest, DerivativeAgreesWithDifferences) {
  target_.positions[1]
      .block<3, 1>(3 * 4, kFrame)
      .setConstant(std::numeric_limits<double>::quiet_NaN());
  const auto cost = PositionCost::Create(scene_, target_, kFrame);
  std::vector<StateDerivative> derivatives;
  Eigen::VectorXd residuals(cost->num_residuals());
  ASSERT_TRUE(cost->Evaluate(trajectory_, residuals.data(), &derivatives));
  const int n = static_cast<int>(trajectory_.positions[0].rows());
  const Eigen::VectorXd direction = test::RandomVector(2 * n, 2);
  Eigen::VectorXd analytic = Eigen::VectorXd::Zero(cost->num_residuals());
  for (const StateDerivative& d : derivatives) {
    EXPECT_EQ(d.frame, kFrame);
    analytic.segment(d.first_row, d.d_position.rows()) +=
        d.d_position * direction.segment(n * d.object, n);
  }
  const auto check = test::CheckDirectionalDerivative(
      [&](const Eigen::VectorXd& change) {
        Trajectory moved = trajectory_;
        moved.positions[0].col(kFrame) += change.head(n);
        moved.positions[1].col(kFrame) += change.tail(n);
        Eigen::VectorXd r(cost->num_residuals());
        cost->Evaluate(moved, r.data(), nullptr);
        return r;
      },
      Eigen::VectorXd::Zero(2 * n), direction, analytic);
  EXPECT_LT(check.relative_error, 1e-10) << check;
  EXPECT_GT(check.norm, 0.0);
}

TEST_F(PositionCostTest, ReadsOnlyWhatIsEstimatedAndObserved) {
  ApplySettings("nn,Gn", &scene_);
  const auto cost = PositionCost::Create(scene_, target_, kFrame);
  ASSERT_EQ(cost->states().size(), 1u);
  EXPECT_EQ(cost->states()[0].object, 1);
  EXPECT_EQ(cost->states()[0].frame, kFrame);
  target_.positions[1].col(kFrame).setConstant(
      std::numeric_limits<double>::quiet_NaN());
  EXPECT_EQ(PositionCost::Create(scene_, target_, kFrame), nullptr);
  // Frame 0 is given, frame 3 is not observed any more.
  EXPECT_EQ(MakePositionCosts(scene_, target_, 6).size(), 4u);
}

}  // namespace
}  // namespace dpe
