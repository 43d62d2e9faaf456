#include "dpe/estimation/trajectory_cost_check.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <utility>
#include <vector>

#include "dpe/engine/simulator.h"
#include "support/test_scenes.h"

namespace dpe {
namespace {

using ::testing::HasSubstr;

constexpr int kVertex = 5;

// A correct cost on object 0 at frames 2 and 4, and what a test may break of it.
class BreakableCost : public TrajectoryCost {
 public:
  BreakableCost() : BreakableCost({{0, 2}, {0, 4}}) {}
  explicit BreakableCost(std::vector<StateReference> states)
      : TrajectoryCost(2, std::move(states)) {}

  bool Evaluate(const Trajectory& trajectory, double* residuals,
                std::vector<StateDerivative>* derivatives) const override {
    const auto x = trajectory.positions[0].col(2).segment<3>(3 * kVertex);
    const auto v = trajectory.velocities[0].col(4).segment<3>(3 * kVertex);
    residuals[0] = x.squaredNorm();
    residuals[1] = std::sin(v[1]) + 1e-3 * x[0];
    if (derivatives == nullptr) return true;
    const Eigen::Index size = trajectory.positions[0].rows();
    StateDerivative at_2, at_4;
    at_2.frame = 2;
    at_2.d_position.resize(2, size);
    for (int c = 0; c < 3; ++c) {
      at_2.d_position.insert(0, 3 * kVertex + c) = 2.0 * x[c];
    }
    at_2.d_position.insert(1, 3 * kVertex) = 1e-3;
    at_4.frame = 4;
    at_4.first_row = 1;
    at_4.d_position.resize(1, size);
    at_4.d_velocity.resize(1, size);
    at_4.d_velocity.insert(0, 3 * kVertex + 1) = std::cos(v[1]);
    if (break_derivatives) break_derivatives(&at_2, &at_4);
    derivatives->push_back(at_2);
    derivatives->push_back(at_4);
    if (change_residuals) residuals[0] += 1e-6;
    return !fail_with_derivatives;
  }

  std::function<void(StateDerivative* at_2, StateDerivative* at_4)> break_derivatives;
  bool change_residuals = false;
  bool fail_with_derivatives = false;
};

class TrajectoryCostCheckTest : public ::testing::Test {
 protected:
  TrajectoryCostCheckTest() {
    Scene scene = test::MakeDerivativeScene("flag", 4);
    test::Perturb(1, &scene);
    trajectory_ = Simulator(scene).Simulate(6);
  }

  void ExpectRefused(const std::string& message) const {
    const TrajectoryCostCheck check = CheckTrajectoryCost(cost_, trajectory_);
    EXPECT_FALSE(check.ok);
    EXPECT_THAT(check.message, HasSubstr(message));
  }

  Trajectory trajectory_;
  BreakableCost cost_;
};

TEST_F(TrajectoryCostCheckTest, AcceptsACorrectCost) {
  const TrajectoryCostCheck check = CheckTrajectoryCost(cost_, trajectory_, 1e-8);
  EXPECT_TRUE(check.ok) << check.message;
  EXPECT_LT(check.relative_error, 1e-8);
}

TEST_F(TrajectoryCostCheckTest, NamesTheWorstEntry) {
  cost_.break_derivatives = [](StateDerivative* at_2, StateDerivative* at_4) {
    at_2->d_position.coeffRef(0, 3 * kVertex + 1) *= 1.0 + 1e-4;
    at_4->d_velocity.coeffRef(0, 3 * kVertex + 1) *= 1.01;
  };
  const TrajectoryCostCheck check = CheckTrajectoryCost(cost_, trajectory_);
  EXPECT_FALSE(check.ok);
  EXPECT_NEAR(check.relative_error, 0.01, 1e-6);
  EXPECT_EQ(check.worst.residual, 1);
  EXPECT_EQ(check.worst.object, 0);
  EXPECT_EQ(check.worst.frame, 4);
  EXPECT_EQ(check.worst.vertex, kVertex);
  EXPECT_EQ(check.worst.axis, 'y');
  EXPECT_TRUE(check.worst.is_velocity);
  EXPECT_NEAR(check.worst.analytic, 1.01 * check.worst.numeric, 1e-6);
  EXPECT_THAT(check.message, HasSubstr("residual 1 with respect to velocity y of "
                                       "vertex 5, object 0 at frame 4"));
}

TEST_F(TrajectoryCostCheckTest, RefusesEveryPoisonedEntry) {
  const std::vector<std::pair<int, int>> entries = {
      {0, 3 * kVertex}, {0, 3 * kVertex + 1}, {1, 3 * kVertex + 2}, {0, 3}, {1, 47}};
  for (const auto& entry : entries) {
    cost_.break_derivatives = [&](StateDerivative* at_2, StateDerivative*) {
      at_2->d_position.coeffRef(entry.first, entry.second) += 1e-4;
    };
    const TrajectoryCostCheck check = CheckTrajectoryCost(cost_, trajectory_);
    EXPECT_FALSE(check.ok) << entry.first << "," << entry.second;
    EXPECT_EQ(check.worst.residual, entry.first);
    EXPECT_EQ(check.worst.vertex, entry.second / 3);
    EXPECT_EQ(check.worst.axis, "xyz"[entry.second % 3]);
    EXPECT_NEAR(check.worst.analytic - check.worst.numeric, 1e-4, 2e-6);
  }
}

TEST_F(TrajectoryCostCheckTest, RefusesADerivativeThatIsNotANumber) {
  cost_.break_derivatives = [](StateDerivative* at_2, StateDerivative*) {
    at_2->d_position.coeffRef(0, 3 * kVertex) = std::nan("");
  };
  ExpectRefused("residual 0 with respect to position x of vertex 5");
}

TEST_F(TrajectoryCostCheckTest, RefusesAMissingDerivative) {
  cost_.break_derivatives = [](StateDerivative*, StateDerivative* at_4) {
    at_4->d_velocity.resize(0, 0);
  };
  ExpectRefused("residual 1 with respect to velocity y of vertex 5");
}

TEST_F(TrajectoryCostCheckTest, RefusesStatesThatAreReadButNotListed) {
  const BreakableCost cost(std::vector<TrajectoryCost::StateReference>{{0, 2}});
  EXPECT_THAT(CheckTrajectoryCost(cost, trajectory_).message,
              HasSubstr("derivative with respect to object 0 at frame 4, which the "
                        "cost does not list"));
  BreakableCost silent(std::vector<TrajectoryCost::StateReference>{{0, 2}});
  silent.break_derivatives = [](StateDerivative* at_2, StateDerivative* at_4) {
    *at_4 = *at_2;
    at_4->d_position.setZero();
  };
  EXPECT_THAT(CheckTrajectoryCost(silent, trajectory_).message,
              HasSubstr("reads states that it does not list"));
  const BreakableCost beyond({{0, 2}, {0, 4}, {0, 6}});
  EXPECT_THAT(CheckTrajectoryCost(beyond, trajectory_).message,
              HasSubstr("object 0 at frame 6, which the trajectory does not hold"));
}

TEST_F(TrajectoryCostCheckTest, RefusesWrongSizes) {
  cost_.break_derivatives = [](StateDerivative* at_2, StateDerivative*) {
    at_2->d_position.resize(2, 12);
  };
  ExpectRefused("d_position of size 2 x 12");
  cost_.break_derivatives = [](StateDerivative*, StateDerivative* at_4) {
    at_4->first_row = 2;
  };
  ExpectRefused("residuals 2 to 2; accepted are 0 to 1");
}

TEST_F(TrajectoryCostCheckTest, RefusesCostsThatAnswerDifferently) {
  cost_.change_residuals = true;
  ExpectRefused("the residuals differ when derivatives are asked for");
  cost_.change_residuals = false;
  cost_.fail_with_derivatives = true;
  ExpectRefused("without derivatives, but not with them");
  trajectory_.positions[0](3 * kVertex, 2) = std::nan("");
  ExpectRefused("not finite");
}

}  // namespace
}  // namespace dpe
