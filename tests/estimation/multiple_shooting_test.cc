#include "dpe/estimation/multiple_shooting.h"

#include <ceres/normal_prior.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "fit_support.h"
#include "shooting_windows.h"
#include "state_guess.h"
#include "support/derivative_checker.h"
#include "support/test_scenes.h"

namespace dpe {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

// A preset whose values its settings can express.
Scene MakeScene(const std::string& preset, int side, const std::string& settings) {
  Scene scene = test::MakeDerivativeScene(preset, side);
  ApplySettings(settings, &scene);
  const ParameterLayout layout(scene);
  layout.Insert(layout.Extract(scene), &scene);
  return scene;
}

// What every `every`-th vertex did.
Observations Some(Observations observations, int every) {
  for (Eigen::MatrixXd& p : observations.positions) {
    for (int v = 0; v < p.rows() / 3; ++v) {
      if (v % every != 0) p.block(3 * v, 1, 3, p.cols() - 1).setConstant(kNan);
    }
  }
  return observations;
}

double LargestDeviation(const Eigen::VectorXd& p, const Eigen::VectorXd& truth) {
  return ((p - truth).array() / truth.array()).abs().maxCoeff();
}

// Root mean square of a cost of complete or partial observations, m.
double Rms(double cost, const Scene& scene, const Observations& observations) {
  int count = 0;
  for (int v = 0; v < scene.objects[0].num_vertices(); ++v) {
    for (int f = 1; f < observations.num_frames(); ++f) {
      count += !scene.objects[0].is_fixed[v] && observations.IsObserved(0, v, f);
    }
  }
  return std::sqrt(2.0 * cost / count);
}

TEST(ShootingWindows, EveryObservationIsInOneWindow) {
  Scene scene = test::MakeDerivativeScene("two_objects", 4);
  ApplySettings("nL,nL", &scene);
  const int num_frames = 24;
  const Trajectory rollout = Simulator(scene).Simulate(num_frames);
  Observations observations = ObserveAll(rollout);
  for (const double time : {0.0, 0.5, 10.0, 10.25, 19.999, 23.0}) {
    observations.samples.push_back({0, time, Eigen::Vector3d::Zero(), 0.0});
  }
  observations.sigmas = observations.positions;
  const auto windows = CutIntoWindows(scene, observations, rollout, num_frames, 10);
  ASSERT_EQ(windows.size(), 2);  // the last three frames join the second
  size_t num_samples = 0;
  std::vector<int> times_seen(num_frames, 0);
  for (const ShootingWindow& w : windows) {
    ASSERT_EQ(w.observations.positions[0].cols(), w.num_frames);
    for (int f = 0; f < w.num_frames; ++f) {
      if (!w.observations.IsObserved(0, 0, f)) continue;
      ++times_seen[w.first_frame + f];
      for (size_t o = 0; o < 2; ++o) {
        EXPECT_EQ(w.observations.positions[o].col(f),
                  observations.positions[o].col(w.first_frame + f));
        EXPECT_EQ(w.observations.sigmas[o].col(f),
                  observations.sigmas[o].col(w.first_frame + f));
      }
    }
    num_samples += w.observations.samples.size();
    for (const MarkerSample& sample : w.observations.samples) {
      EXPECT_GE(sample.time, 0.0);
      EXPECT_LE(sample.time, w.num_frames - 1);
    }
  }
  EXPECT_EQ(times_seen, std::vector<int>(num_frames, 1));
  EXPECT_EQ(num_samples, observations.samples.size());
  EXPECT_EQ(CutIntoWindows(scene, observations, rollout, 27, 10).size(), 3);
  EXPECT_EQ(CutIntoWindows(scene, observations, rollout, 24, 100).size(), 1);
  EXPECT_EQ(CutIntoWindows(scene, observations, rollout, 5, 1).size(), 4);
}

// Windows that start from a rollout's own states go on as it did, moving pins included.
TEST(ShootingWindows, OfARolloutJoinWithoutJumps) {
  for (const IntegrationMethod method :
       {IntegrationMethod::kSymplecticEuler, IntegrationMethod::kLinearlyImplicitEuler,
        IntegrationMethod::kImplicitEuler, IntegrationMethod::kTrBdf2}) {
    Scene scene = test::MakeDerivativeScene("two_objects", 4);
    test::Perturb(3, &scene);
    ApplySettings("nL,nL", &scene);
    scene.integration_method = method;
    scene.delta = 0.004;
    scene.steps_per_frame = 4;
    const int num_frames = 13;
    const Trajectory rollout = Simulator(scene).Simulate(num_frames);
    ASSERT_TRUE(rollout.status.ok());
    Observations nothing;
    const auto windows = CutIntoWindows(scene, nothing, rollout, num_frames, 3);
    ASSERT_EQ(windows.size(), 4);
    std::vector<TrajectorySegment> segments;
    std::vector<const Scene*> scenes;
    for (const ShootingWindow& window : windows) {
      segments.push_back({window.scene, {}});
      scenes.push_back(&window.scene);
    }
    TrajectoryEvaluator evaluator(std::move(segments), LinkWindows(windows));
    ASSERT_TRUE(evaluator.Evaluate(
        evaluator.map().ToCoordinates(evaluator.joint_layout().Extract(scenes))));
    EXPECT_GT(evaluator.num_residuals(), 0);
    EXPECT_LT(evaluator.residuals().lpNorm<Eigen::Infinity>(), 1e-12)
        << IntegrationMethodName(method);
  }
}

TEST(StateGuess, KeepsWhatIsObservedAndMovesTheRestAlong) {
  const Scene scene = MakeScene("side", 6, "nL");
  const Trajectory truth = Simulator(scene).Simulate(31);
  const Observations some = Some(ObserveAll(truth), 2);
  Scene other = scene;
  other.objects[0].stiffness *= 0.5;
  const Trajectory rollout = Simulator(other).Simulate(31);
  const Eigen::VectorXd nan = Eigen::VectorXd::Constant(108, kNan);
  const Eigen::VectorXd x = truth.positions[0].col(30), v = truth.velocities[0].col(30);
  const Eigen::VectorXd rx = rollout.positions[0].col(30),
                        rv = rollout.velocities[0].col(30);
  const StateGuess guess = GuessState(scene, 0, some, rx, rv, 30);
  const StateGuess blind = GuessState(scene, 0, some, nan, nan, 30);
  for (int i = 0; i < 30; i += 2) {  // vertices 30 to 35 are fixed
    EXPECT_EQ(guess.position.segment<3>(3 * i), x.segment<3>(3 * i));
    EXPECT_LT((guess.velocity - v).segment<3>(3 * i).norm(), 1e-12);
    EXPECT_EQ(blind.position.segment<3>(3 * i), x.segment<3>(3 * i));
  }
  EXPECT_LT((guess.position - x).norm(), 0.5 * (rx - x).norm());
  EXPECT_LT((blind.position - x).norm(), 0.5 * (scene.objects[0].positions - x).norm());
  // Without any observation it is the rollout's own state; a wild one is not taken.
  const StateGuess own = GuessState(scene, 0, {}, rx, rv, 30);
  EXPECT_EQ(own.position, rx);
  EXPECT_EQ(own.velocity, rv);
  const StateGuess wild = GuessState(scene, 0, some, 1e6 * rx, 1e6 * rv, 30);
  EXPECT_EQ(wild.position, blind.position);
}

// The motion but for the frames from 1 to `last`.
Observations WithGap(Observations observations, int last) {
  for (Eigen::MatrixXd& p : observations.positions) {
    p.middleCols(1, last).setConstant(kNan);
  }
  return observations;
}

// A flag in the wind whose first frames are missing: from stiffnesses of 10 N/m a fit
// of the whole motion ends in a valley of the cost. Windows join at the answer.
TEST(MultipleShooting, FindsTheAnswerWhereTheFullHorizonEndsInAValley) {
  const Scene scene = MakeScene("flag", 8, "nR");
  constexpr int kFrames = 60;
  const Observations observations = WithGap(test::OwnMotion(scene, kFrames), 10);
  const Eigen::VectorXd truth = ParameterLayout(scene).Extract(scene);
  EstimatorOptions full;
  full.init = InitMethod::kUniform;
  full.uniform_value = 10.0;
  full.horizon = Horizon::kFull;
  full.max_checked_parameters = 0;
  const EstimatorSummary valley = Estimate(scene, observations, full);
  EXPECT_TRUE(valley.usable());
  EXPECT_GT(valley.final_rms, 0.1);

  const MultipleShootingSummary found = MultipleShooting(
      scene, observations, kFrames, Eigen::VectorXd::Constant(truth.size(), 10.0));
  EXPECT_TRUE(found.ok && found.joined) << found.message;
  EXPECT_EQ(found.num_windows, 6);
  EXPECT_LT(found.stages.back().largest_jump, 1e-4);
  EXPECT_LT(Rms(found.final_cost, scene, observations), 1e-12);
  EXPECT_LT(LargestDeviation(found.parameters, truth), 1e-9);
}

struct Case {
  const char* preset;
  int side;
  const char* settings;
  int num_frames;
  int every;  // vertex is observed
};

class ShootingRecoveryTest : public ::testing::TestWithParam<Case> {};

// Noise-free motions, from 10 N/m for every spring (the truth is 2.5 to 50).
TEST_P(ShootingRecoveryTest, RecoversTheTruthFromAUniformStart) {
  const Case c = GetParam();
  const Scene scene = MakeScene(c.preset, c.side, c.settings);
  const Eigen::VectorXd truth = ParameterLayout(scene).Extract(scene);
  const Observations observations = Some(test::OwnMotion(scene, c.num_frames), c.every);
  const MultipleShootingSummary found =
      MultipleShooting(test::WithEstimatesOverwritten(scene, 10.0), observations,
                       c.num_frames, Eigen::VectorXd::Constant(truth.size(), 10.0));
  EXPECT_TRUE(found.ok && found.joined) << found.message;
  EXPECT_LT(Rms(found.final_cost, scene, observations), 1e-9);
  EXPECT_LT(LargestDeviation(found.parameters, truth), 1e-6);
}

const auto kCaseName = [](const auto& info) {
  return std::string(info.param.preset) + info.param.settings +
         std::to_string(info.param.side) + "_" + std::to_string(info.param.num_frames) +
         "_" + std::to_string(info.param.every);
};

INSTANTIATE_TEST_SUITE_P(All, ShootingRecoveryTest,
                         ::testing::Values(Case{"corners", 5, "nL", 100, 2},
                                           Case{"flag_no_wind", 5, "nL", 100, 1}),
                         kCaseName);

// The last one's whole motion cannot even be simulated from that start.
INSTANTIATE_TEST_SUITE_P(Long, ShootingRecoveryTest,
                         ::testing::Values(Case{"side", 6, "nL", 150, 3},
                                           Case{"flag", 8, "nL", 60, 1},
                                           Case{"flag", 8, "nR", 100, 2}),
                         kCaseName);

// From 10 N/m the first 22 frames of this flag cannot be simulated.
TEST(MultipleShooting, HalvesWindowsThatCannotBeSimulated) {
  const Scene scene = MakeScene("flag", 6, "nG");
  const int num_frames = 45;
  const Observations observations = test::OwnMotion(scene, num_frames);
  MultipleShootingOptions options;
  options.window_frames = 40;
  const MultipleShootingSummary found = MultipleShooting(
      scene, observations, num_frames, Eigen::VectorXd::Constant(1, 10.0), options);
  EXPECT_LT(found.window_frames, 40);
  EXPECT_TRUE(found.ok && found.joined) << found.message;
  EXPECT_LT(Rms(found.final_cost, scene, observations), 1e-9);
}

TEST(MultipleShooting, WithNoiseItEndsWhereAFitFromTheTruthDoes) {
  Scene scene = MakeScene("side", 5, "nR");
  scene.objects[0].estimate_damping = true;
  const int num_frames = 80;
  Observations observations = test::OwnMotion(scene, num_frames);
  AddNoise(scene, 0.005, 3, &observations);
  const ParameterLayout layout(scene);
  const Eigen::VectorXd truth = layout.Extract(scene);
  MultipleShootingOptions options;
  options.stage_tolerance = 1e-3;
  const MultipleShootingSummary found =
      MultipleShooting(scene, observations, num_frames, 3.0 * truth, options);
  EXPECT_TRUE(found.ok && found.joined) << found.message;
  // Weights had to grow, and jumps fell with them.
  ASSERT_GE(found.stages.size(), 2);
  for (size_t s = 1; s < found.stages.size(); ++s) {
    EXPECT_GT(found.stages[s].weight, found.stages[s - 1].weight);
    EXPECT_LT(found.stages[s].largest_jump, found.stages[s - 1].largest_jump);
    EXPECT_GT(found.stages[s].data_cost, found.stages[s - 1].data_cost);
  }
  EXPECT_LE(found.final_cost, found.joined_cost);
  EstimatorOptions from_truth;
  from_truth.init = InitMethod::kScene;
  const EstimatorSummary best = Estimate(scene, observations, from_truth);
  EXPECT_NEAR(found.final_cost, best.final_cost, 1e-6 * best.final_cost);
  EXPECT_LT(LargestDeviation(found.parameters, best.parameters), 1e-4);
}

TEST(MultipleShooting, EstimatesWhereAndHowFastTheMotionBeganToo) {
  Scene scene = MakeScene("side", 4, "nG");
  ClothObject& cloth = scene.objects[0];
  cloth.rest_length = RestLengths(cloth);
  test::Perturb(3, &scene);
  const ParameterLayout constant(scene);
  constant.Insert(constant.Extract(scene), &scene);
  cloth.estimate_initial_velocity = true;
  cloth.estimate_drag = true;
  const int num_frames = 40;
  const ParameterLayout layout(scene);
  const Eigen::VectorXd truth = layout.Extract(scene);
  Eigen::VectorXd start = 2.0 * truth;
  for (const ParameterBlock& block : layout.blocks()) {
    if (block.kind != ParameterKind::kInitialVelocity) continue;
    start.segment(block.offset, block.size).setZero();
  }
  const MultipleShootingSummary found =
      MultipleShooting(scene, test::OwnMotion(scene, num_frames), num_frames, start);
  EXPECT_TRUE(found.ok && found.joined) << found.message;
  EXPECT_EQ(found.num_windows, 4);
  EXPECT_LT((found.parameters - truth).norm(), 1e-8 * truth.norm());
}

TEST(MultipleShooting, ResultDoesNotDependOnTheNumberOfThreads) {
  const Scene scene = MakeScene("side", 4, "nL");
  const Observations observations = Some(test::OwnMotion(scene, 40), 2);
  std::vector<Eigen::VectorXd> results;
  for (const int num_threads : {1, 3}) {
    MultipleShootingOptions options;
    options.evaluator.num_threads = num_threads;
    options.evaluator.jacobian = JacobianMethod::kTangent;
    options.max_polish_iterations = 5;
    options.max_iterations_per_stage = 10;
    results.push_back(
        MultipleShooting(scene, observations, 40,
                         Eigen::VectorXd::Constant(ParameterLayout(scene).size(), 10.0),
                         options)
            .parameters);
  }
  EXPECT_EQ(results[0], results[1]);
}

TEST(MultipleShooting, FurtherResidualsTakePartInWindowsAndInTheWhole) {
  const Scene scene = MakeScene("side", 4, "nG");
  const Observations observations = test::OwnMotion(scene, 30);
  const double truth = ParameterLayout(scene).Extract(scene)[0];
  MultipleShootingOptions options;
  std::vector<int> segments;
  options.add_residuals = [&](TrajectoryProblem* problem) {
    segments.push_back(problem->evaluator()->num_segments());
    problem->least_squares()->AddResidualBlock(
        new ceres::NormalPrior(Eigen::MatrixXd::Constant(1, 1, 1e4),
                               Eigen::VectorXd::Constant(1, std::log(2.0 * truth))),
        nullptr, problem->block_coordinates(0));
  };
  const MultipleShootingSummary found = MultipleShooting(
      scene, observations, 30, Eigen::VectorXd::Constant(1, truth), options);
  EXPECT_EQ(segments, (std::vector<int>{3, 1}));
  EXPECT_NEAR(found.parameters[0], 2.0 * truth, 1e-3 * truth);
}

TEST(MultipleShooting, RefusesWhatMakesNoSenseAndStopsWhenAsked) {
  Scene scene = MakeScene("side", 4, "nG");
  const Observations observations = test::OwnMotion(scene, 30);
  const Eigen::VectorXd start = Eigen::VectorXd::Constant(1, 10.0);
  MultipleShootingOptions options;
  EXPECT_THROW(MultipleShooting(scene, observations, 1, start), SceneError);
  EXPECT_THROW(MultipleShooting(scene, {}, 30, start), SceneError);
  options.window_frames = 0;
  EXPECT_THROW(MultipleShooting(scene, observations, 30, start, options), SceneError);
  options.window_frames = 10;
  options.weight_factor = 1.0;
  EXPECT_THROW(MultipleShooting(scene, observations, 30, start, options), SceneError);
  options.weight_factor = 10.0;
  options.evaluator.interrupted = [] { return true; };
  const MultipleShootingSummary stopped =
      MultipleShooting(scene, observations, 30, start, options);
  EXPECT_FALSE(stopped.ok);
  EXPECT_NEAR(stopped.parameters[0], start[0], 1e-12);
  ApplySettings("nn", &scene);
  EXPECT_THROW(MultipleShooting(scene, observations, 30, {}), SceneError);
}

}  // namespace
}  // namespace dpe
