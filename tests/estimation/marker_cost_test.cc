// Residuals on markers between vertices and at times between frames.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "dpe/engine/simulator.h"
#include "dpe/estimation/trajectory_cost.h"
#include "frame_interpolation.h"
#include "support/derivative_checker.h"
#include "support/test_scenes.h"

namespace dpe {
namespace {

constexpr int kFrames = 7;

TEST(FrameInterpolationTest, ReproducesCubicsAndFrames) {
  const auto cubic = [](double t) { return 2.0 - t + 0.5 * t * t - 0.1 * t * t * t; };
  for (const double time : {0.0, 0.2, 1.0, 2.7, 3.5, 5.9, 6.0}) {
    const FrameWeights frames = InterpolateFrames(time, kFrames);
    EXPECT_EQ(frames.count, std::floor(time) == time ? 1 : 4);
    ASSERT_GE(frames.first, 0);
    ASSERT_LE(frames.first + frames.count, kFrames);
    double value = 0.0;
    for (int k = 0; k < frames.count; ++k) {
      value += frames.weights[k] * cubic(frames.first + k);
    }
    EXPECT_NEAR(value, cubic(time), 1e-13) << time;
  }
  EXPECT_EQ(InterpolateFrames(0.5, 2).count, 2);
  EXPECT_EQ(InterpolateFrames(3.0 + 1e-11, kFrames).count, 1);
}

class MarkerCostTest : public ::testing::Test {
 protected:
  MarkerCostTest() {
    ApplySettings("nL", &scene_);
    trajectory_ = Simulator(scene_).Simulate(kFrames);
    observations_.markers.push_back({"m0", 0, {0, 1, 3}, {0.2, 0.5, 0.3}, 0.0});
    observations_.markers.push_back({"m1", 0, {4}, {1.0}, 0.0});
    for (const double time : {0.0, 1.3, 1.6, 3.0, 4.25, 5.9}) {
      for (int marker = 0; marker < 2; ++marker) {
        observations_.samples.push_back(
            {marker, time, 0.1 * test::RandomVector(3, 10 + marker), 0.02});
      }
    }
  }

  // Residuals of all costs, in their order.
  Eigen::VectorXd Residuals(const TrajectoryCosts& costs, const Trajectory& trajectory,
                            std::vector<StateDerivative>* derivatives) const {
    int rows = 0;
    for (const auto& cost : costs) rows += cost->num_residuals();
    Eigen::VectorXd r(rows);
    int row = 0;
    for (const auto& cost : costs) {
      const size_t begin = derivatives != nullptr ? derivatives->size() : 0;
      EXPECT_TRUE(cost->Evaluate(trajectory, r.data() + row, derivatives));
      for (size_t i = begin; derivatives != nullptr && i < derivatives->size(); ++i) {
        (*derivatives)[i].first_row += row;
      }
      row += cost->num_residuals();
    }
    return r;
  }

  Scene scene_ = test::MakeDerivativeScene("side", 3);
  Trajectory trajectory_;
  Observations observations_;
};

TEST_F(MarkerCostTest, IsTheWhitenedDifferenceOfTheInterpolatedPoint) {
  const TrajectoryCosts costs = MakePositionCosts(scene_, observations_, kFrames);
  // Not the given initial state.
  const Eigen::VectorXd r = Residuals(costs, trajectory_, nullptr);
  ASSERT_EQ(r.size(), 3 * 10);
  double sum = 0.0;
  for (const MarkerSample& sample : observations_.samples) {
    if (sample.time == 0.0) continue;
    const Eigen::Vector3d simulated = MarkerPosition(
        trajectory_, observations_.markers[sample.marker], sample.time, kFrames);
    sum += (simulated - sample.position).squaredNorm() / (0.02 * 0.02);
  }
  EXPECT_NEAR(r.squaredNorm(), sum, 1e-10 * sum);
  EXPECT_TRUE(r.allFinite());
}

TEST_F(MarkerCostTest, DerivativeAgreesWithDifferencesForEveryLoss) {
  for (const LossType loss :
       {LossType::kNone, LossType::kHuber, LossType::kCauchy, LossType::kTukey}) {
    PositionCostOptions options;
    options.loss = loss;
    options.loss_scale = 60.0;
    const TrajectoryCosts costs =
        MakePositionCosts(scene_, observations_, kFrames, options);
    std::vector<StateDerivative> derivatives;
    const Eigen::VectorXd r = Residuals(costs, trajectory_, &derivatives);
    const int n = static_cast<int>(trajectory_.positions[0].rows());
    const Eigen::VectorXd direction = 0.1 * test::RandomVector(n * kFrames, 2);
    Eigen::VectorXd analytic = Eigen::VectorXd::Zero(r.size());
    for (const StateDerivative& d : derivatives) {
      analytic.segment(d.first_row, d.d_position.rows()) +=
          d.d_position * direction.segment(n * d.frame, n);
    }
    const auto check = test::CheckDirectionalDerivative(
        [&](const Eigen::VectorXd& change) {
          Trajectory moved = trajectory_;
          for (int f = 0; f < kFrames; ++f) {
            moved.positions[0].col(f) += change.segment(n * f, n);
          }
          return Residuals(costs, moved, nullptr);
        },
        Eigen::VectorXd::Zero(n * kFrames), direction, analytic);
    EXPECT_LT(check.relative_error, 1e-8) << LossTypeName(loss) << check;
    EXPECT_GT(check.norm, 0.0);
  }
}

TEST_F(MarkerCostTest, ALossMakesTheCostRho) {
  PositionCostOptions options;
  options.loss = LossType::kCauchy;
  const RobustLoss loss(options.loss, RobustLoss::DefaultScale(options.loss));
  const Eigen::VectorXd plain = Residuals(
      MakePositionCosts(scene_, observations_, kFrames), trajectory_, nullptr);
  const Eigen::VectorXd bent = Residuals(
      MakePositionCosts(scene_, observations_, kFrames, options), trajectory_, nullptr);
  double sum = 0.0;
  for (int i = 0; i < plain.size(); i += 3) {
    sum += loss.Rho(plain.segment<3>(i).squaredNorm());
  }
  EXPECT_NEAR(bent.squaredNorm(), sum, 1e-12 * sum);
  EXPECT_LT(sum, 0.5 * plain.squaredNorm());
}

TEST_F(MarkerCostTest, VerticesAtFramesAreTheSameAsAMatrixOfPositions) {
  Observations as_positions;
  as_positions.positions = {trajectory_.positions[0]};
  as_positions.positions[0].array() += 0.01;
  as_positions.sigma = 0.3;
  Observations as_samples;
  as_samples.sigma = 0.3;
  for (int v = 0; v < scene_.objects[0].num_vertices(); ++v) {
    as_samples.markers.push_back({"", 0, {v}, {1.0}, 0.0});
    for (int f = 0; f < kFrames; ++f) {
      const Eigen::Vector3d position =
          as_positions.positions[0].col(f).segment<3>(3 * v);
      as_samples.samples.push_back({v, static_cast<double>(f), position, 0.0});
    }
  }
  EXPECT_EQ(
      Residuals(MakePositionCosts(scene_, as_positions, kFrames), trajectory_, nullptr),
      Residuals(MakePositionCosts(scene_, as_samples, kFrames), trajectory_, nullptr));
  EXPECT_NEAR(RmsPositionError(trajectory_, as_samples, kFrames),
              RmsPositionError(trajectory_, as_positions, kFrames), 1e-15);
}

TEST_F(MarkerCostTest, MarkersOnFixedVerticesDoNotCountAndTheHorizonIsKept) {
  Observations on_fixed = observations_;
  int fixed = 0;
  while (!scene_.objects[0].is_fixed[fixed]) ++fixed;
  on_fixed.markers[0] = {"pin", 0, {fixed}, {1.0}, 0.0};
  on_fixed.markers[1] = on_fixed.markers[0];
  EXPECT_TRUE(MakePositionCosts(scene_, on_fixed, kFrames).empty());
  for (const auto& cost : MakePositionCosts(scene_, observations_, 4)) {
    for (const auto& state : cost->states()) EXPECT_LT(state.frame, 4);
  }
}

TEST_F(MarkerCostTest, NoiseIsKnownOfAllOrOfNone) {
  observations_.samples[3].sigma = 0.0;
  try {
    MakePositionCosts(scene_, observations_, kFrames);
    FAIL();
  } catch (const SceneError& error) {
    EXPECT_THAT(error.what(), ::testing::HasSubstr("all or none"));
  }
  observations_.sigma = 0.1;
  EXPECT_NO_THROW(MakePositionCosts(scene_, observations_, kFrames));
}

}  // namespace
}  // namespace dpe
