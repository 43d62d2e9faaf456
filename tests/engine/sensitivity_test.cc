// Adjoint, tangent and central differences of whole rollouts agree, for every
// integrator, scene and kind of parameter.
#include "dpe/engine/sensitivity.h"

#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <tuple>
#include <vector>

#include "dpe/engine/simulator.h"
#include "support/derivative_checker.h"
#include "support/integration_methods.h"
#include "support/sanitizers.h"
#include "support/scene_derivatives.h"
#include "support/test_scenes.h"

namespace dpe::test {
namespace {

// Vertices per side of the cloths; sanitizers, which slow everything down twentyfold,
// see the same code on smaller ones.
#ifdef DPE_TEST_SANITIZED
constexpr int kHalfResolution = 3;
#else
constexpr int kHalfResolution = 6;
#endif

// How the steps are solved, and what of the rollout is kept.
enum class Way { kDefault, kIterative, kNothingKept, kIterativeNothingKept };

using Case = std::tuple<IntegrationMethod, std::string, int, Way>;

// All positions and velocities of all frames in one vector.
Eigen::VectorXd Flatten(const std::vector<Eigen::MatrixXd>& x,
                        const std::vector<Eigen::MatrixXd>& v) {
  Eigen::Index size = 0;
  for (const auto* states : {&x, &v}) {
    for (const Eigen::MatrixXd& m : *states) size += m.size();
  }
  Eigen::VectorXd result(size);
  Eigen::Index offset = 0;
  for (const auto* states : {&x, &v}) {
    for (const Eigen::MatrixXd& m : *states) {
      result.segment(offset, m.size()) = m.reshaped();
      offset += m.size();
    }
  }
  return result;
}

Eigen::VectorXd Flatten(const Trajectory& t) {
  return Flatten(t.positions, t.velocities);
}

// The inverse of Flatten for the shape of `like`.
void Unflatten(const Eigen::VectorXd& flat, const Trajectory& like,
               std::vector<Eigen::MatrixXd>* x, std::vector<Eigen::MatrixXd>* v) {
  *x = like.positions;
  *v = like.velocities;
  Eigen::Index offset = 0;
  for (auto* states : {x, v}) {
    for (Eigen::MatrixXd& m : *states) {
      m.reshaped() = flat.segment(offset, m.size());
      offset += m.size();
    }
  }
}

// The presets at their own time step, except for the explicit methods, which are not
// stable there.
Scene MakeScene(IntegrationMethod method, const std::string& name, ParameterMode mode,
                int resolution) {
  Scene scene = MakeDerivativeScene(name, resolution);
  scene.integration_method = method;
  if (method == IntegrationMethod::kExplicitEuler ||
      method == IntegrationMethod::kSymplecticEuler) {
    // The second of the two cloths is lighter per spring.
    scene.delta = name == "two_objects" ? 0.0008 : 0.002;
    scene.steps_per_frame = 2;
  } else if (name == "two_objects") {
    scene.steps_per_frame = 2;
  }
  Perturb(7, &scene);
  EstimateEverything(mode, &scene);
  return scene;
}

std::string CaseName(const testing::TestParamInfo<Case>& info) {
  const char* ways[] = {"", "_cg", "_nothing_kept", "_cg_nothing_kept"};
  return IntegrationMethodName(std::get<0>(info.param)) + "_" +
         std::get<1>(info.param) + "_" + std::to_string(std::get<2>(info.param)) +
         ways[static_cast<int>(std::get<3>(info.param))];
}

class SensitivityTest : public testing::TestWithParam<Case> {};

TEST_P(SensitivityTest, AdjointTangentAndDifferencesAgree) {
  const auto [method, name, num_frames, way] = GetParam();
  Scene scene =
      MakeScene(method, name, ParameterMode::kLocal,
                name == "two_objects" ? kHalfResolution + 1 : 2 * kHalfResolution);
  SimulatorOptions options;
  const bool iterative = way == Way::kIterative || way == Way::kIterativeNothingKept;
  if (iterative) {
    scene.solver = "cg";
    scene.tolerance = 1e-12;
  }
  if (way == Way::kNothingKept || way == Way::kIterativeNothingKept) {
    options.memory_limit_bytes = 0;
    scene.steps_per_frame = 2;
  }
  const double duality_tolerance = iterative ? 1e-9 : 1e-10;
  Simulator simulator(scene, options);
  const ParameterLayout& layout = simulator.layout();
  const Eigen::VectorXd p = layout.Extract(scene);
  const int frames = num_frames;
  const auto flat_rollout = [&](const Eigen::VectorXd& parameters) {
    const Rollout rollout = simulator.Run(parameters, frames);
    EXPECT_TRUE(rollout.status().ok()) << rollout.status().Message();
    return Flatten(rollout.trajectory());
  };
  const Rollout rollout = simulator.Run(p, frames);
  ASSERT_TRUE(rollout.status().ok()) << rollout.status().Message();

  // A random functional of all states, and its gradient by the adjoint.
  const Eigen::VectorXd mu =
      RandomVector(static_cast<int>(Flatten(rollout.trajectory()).size()), 11);
  std::vector<Eigen::MatrixXd> mu_x, mu_v;
  Unflatten(mu, rollout.trajectory(), &mu_x, &mu_v);
  Sensitivity sensitivity(&simulator, &rollout);
  const Eigen::VectorXd gradient = sensitivity.Gradient(mu_x, mu_v);

  for (const ParameterBlock& block : layout.blocks()) {
    SCOPED_TRACE(ParameterKindName(block.kind) + " of object " +
                 std::to_string(block.object));
    Eigen::VectorXd dp = Eigen::VectorXd::Zero(p.size());
    for (int i = block.offset; i < block.offset + block.size; ++i) {
      dp[i] = ParameterKindIsPositive(block.kind) ? p[i] : 1.0;
    }
    dp.segment(block.offset, block.size).array() *=
        RandomVector(block.size, 100 + block.offset).array();
    std::vector<Eigen::MatrixXd> dx, dv;
    Sensitivity(&simulator, &rollout).JacobianVectorProduct(dp, &dx, &dv);
    const Eigen::VectorXd tangent = Flatten(dx, dv);
    ASSERT_GT(tangent.norm(), 0.0);

    const DerivativeCheck check =
        CheckDirectionalDerivative(flat_rollout, p, dp, tangent);
    EXPECT_LT(check.relative_error, 1e-6) << check;
    const double scale = mu.norm() * tangent.norm();
    EXPECT_NEAR(gradient.dot(dp), mu.dot(tangent), duality_tolerance * scale);
    // The same identity relative to the product itself, where it is not small by
    // accident.
    if (std::abs(mu.dot(tangent)) > 1e-2 * scale) {
      EXPECT_NEAR(gradient.dot(dp) / mu.dot(tangent), 1.0, duality_tolerance);
    }
    // A derivative that is off by one part in a thousand is caught.
    const DerivativeCheck poisoned =
        CheckDirectionalDerivative(flat_rollout, p, dp, 1.001 * tangent, {1e-5});
    EXPECT_GT(poisoned.relative_error, 5e-4);
  }
  EXPECT_TRUE(sensitivity.ok());
}

class KeptFactorizationTest : public testing::TestWithParam<IntegrationMethod> {};

TEST_P(KeptFactorizationTest, GradientDoesNotDependOnWhatWasKept) {
  const Scene scene = MakeScene(GetParam(), "corners", ParameterMode::kLocal, 8);
  const int num_frames = 12;
  std::vector<Eigen::VectorXd> gradients;
  // Nothing kept, a few steps (one takes about 0.1 MB), all steps.
  for (const std::size_t bytes : {0u, 400'000u, 500'000'000u}) {
    SimulatorOptions options;
    options.memory_limit_bytes = bytes;
    Simulator simulator(scene, options);
    const Eigen::VectorXd p = simulator.layout().Extract(scene);
    // The second rollout reuses the solvers of the first.
    for (int repeat = 0; repeat < 2; ++repeat) {
      const Rollout rollout = simulator.Run(p, num_frames);
      ASSERT_TRUE(rollout.status().ok()) << rollout.status().Message();
      Sensitivity sensitivity(&simulator, &rollout);
      gradients.push_back(sensitivity.Gradient(rollout.trajectory().positions,
                                               rollout.trajectory().velocities));
      ASSERT_TRUE(sensitivity.ok());
    }
  }
  for (const Eigen::VectorXd& gradient : gradients) {
    EXPECT_LT((gradient - gradients[0]).norm(), 1e-12 * gradients[0].norm());
  }
}

INSTANTIATE_TEST_SUITE_P(All, KeptFactorizationTest,
                         testing::Values(IntegrationMethod::kLinearlyImplicitEuler,
                                         IntegrationMethod::kImplicitEuler,
                                         IntegrationMethod::kTrBdf2),
                         MethodCaseName);

// With the Krylov solver derivatives are exact to its tolerance.
TEST_P(KeptFactorizationTest, IterativeSolverFollowsItsTolerance) {
  Scene scene = MakeScene(GetParam(), "corners", ParameterMode::kLocal, 8);
  const auto gradient = [&](const std::string& solver, double tolerance) {
    scene.solver = solver;
    scene.tolerance = tolerance;
    Simulator simulator(scene);
    const Rollout rollout = simulator.Run(simulator.layout().Extract(scene), 12);
    EXPECT_TRUE(rollout.status().ok()) << rollout.status().Message();
    return Sensitivity(&simulator, &rollout)
        .Gradient(rollout.trajectory().positions, rollout.trajectory().velocities);
  };
  const Eigen::VectorXd exact = gradient("cholesky", 1e-5);
  const auto error = [&](double tolerance) {
    return (gradient("cg", tolerance) - exact).norm() / exact.norm();
  };
  EXPECT_LT(error(1e-5), 1e-3);
  EXPECT_GT(error(1e-5), 1e-12);
  EXPECT_LT(error(1e-12), 1e-9);
  EXPECT_EQ(gradient("auto", 1e-5), exact);  // a small cloth
}

// The Jacobian of chosen rows, both ways, against the tangent of single directions.
class JacobianTest : public testing::TestWithParam<IntegrationMethod> {};

TEST_P(JacobianTest, TangentAndAdjointGiveTheSameRows) {
  for (const ParameterMode mode :
       {ParameterMode::kLocal, ParameterMode::kGlobal, ParameterMode::kGroup}) {
    const Scene scene = MakeScene(GetParam(), "two_objects", mode, 5);
    SimulatorOptions options;
    options.num_threads = 2;
    Simulator simulator(scene, options);
    const Eigen::VectorXd p = simulator.layout().Extract(scene);
    const int num_frames = 6;
    const Rollout rollout = simulator.Run(p, num_frames);
    ASSERT_TRUE(rollout.status().ok()) << rollout.status().Message();
    int num_rows = 0;
    const auto rows = RandomRows(scene, num_frames, &num_rows);
    Sensitivity sensitivity(&simulator, &rollout);
    const RowMajorMatrix tangent =
        sensitivity.Jacobian(rows, num_rows, JacobianMethod::kTangent);
    const RowMajorMatrix adjoint =
        sensitivity.Jacobian(rows, num_rows, JacobianMethod::kAdjoint);
    ASSERT_TRUE(sensitivity.ok());
    EXPECT_LT((tangent - adjoint).norm(), 1e-10 * tangent.norm());

    // Against the tangent of one direction through the whole rollout.
    const Eigen::VectorXd dp =
        RandomVector(static_cast<int>(p.size()), 21).cwiseProduct(p);
    std::vector<Eigen::MatrixXd> dx, dv;
    sensitivity.JacobianVectorProduct(dp, &dx, &dv);
    Eigen::VectorXd expected = Eigen::VectorXd::Zero(num_rows);
    for (const StateDerivative& d : rows) {
      expected.segment(d.first_row, 3) += d.d_position * dx[d.object].col(d.frame);
      if (d.d_velocity.rows() > 0) {
        expected.segment(d.first_row, 3) += d.d_velocity * dv[d.object].col(d.frame);
      }
    }
    EXPECT_LT((tangent * dp - expected).norm(), 1e-10 * expected.norm());
    EXPECT_GT(expected.norm(), 0.0);
  }
}

INSTANTIATE_TEST_SUITE_P(All, JacobianTest, AllIntegrationMethods(), MethodCaseName);

INSTANTIATE_TEST_SUITE_P(All, SensitivityTest,
                         testing::Combine(AllIntegrationMethods(),
                                          testing::ValuesIn(DerivativeSceneNames()),
                                          testing::Values(5, 50),
                                          testing::Values(Way::kDefault)),
                         CaseName);

INSTANTIATE_TEST_SUITE_P(
    Iterative, SensitivityTest,
    testing::Combine(testing::Values(IntegrationMethod::kLinearlyImplicitEuler,
                                     IntegrationMethod::kImplicitEuler,
                                     IntegrationMethod::kTrBdf2),
                     testing::ValuesIn(DerivativeSceneNames()), testing::Values(5),
                     testing::Values(Way::kIterative)),
    CaseName);

INSTANTIATE_TEST_SUITE_P(
    NothingKept, SensitivityTest,
    testing::Combine(AllIntegrationMethods(), testing::Values("two_objects"),
                     testing::Values(5),
                     testing::Values(Way::kNothingKept, Way::kIterativeNothingKept)),
    CaseName);

// One step's worth of polls after the first true: of a pass, or of the steps that it
// takes again. Its status says where.
TEST(InterruptedPassTest, StopsWithinAStep) {
  Scene scene = MakeDerivativeScene("flag", 4);
  scene.steps_per_frame = 3;
  EstimateEverything(ParameterMode::kLocal, &scene);
  constexpr int kFrames = 10;
  int num_rows = 0;
  const auto rows = RandomRows(scene, kFrames, &num_rows);
  for (const std::size_t memory_limit : {std::size_t{1} << 30, std::size_t{0}}) {
    int polls_left = 1 << 30;
    SimulatorOptions options;
    options.memory_limit_bytes = memory_limit;
    options.interrupted = [&] { return --polls_left < 0; };
    Simulator simulator(scene, options);
    const Rollout rollout = simulator.Run(simulator.layout().Extract(scene), kFrames);
    const Eigen::VectorXd dp = Eigen::VectorXd::Ones(simulator.layout().size());
    const std::vector<std::function<void(Sensitivity*)>> passes = {
        [&](Sensitivity* s) { s->Gradient(rollout.trajectory().positions); },
        [&](Sensitivity* s) { s->Jacobian(rows, num_rows, JacobianMethod::kTangent); },
        [&](Sensitivity* s) { s->Jacobian(rows, num_rows, JacobianMethod::kAdjoint); },
        [&](Sensitivity* s) {
          std::vector<Eigen::MatrixXd> dx, dv;
          s->JacobianVectorProduct(dp, &dx, &dv);
        }};
    for (size_t i = 0; i < passes.size(); ++i) {
      for (const int after : {0, 1, 12}) {
        polls_left = after;
        Sensitivity sensitivity(&simulator, &rollout);
        passes[i](&sensitivity);
        EXPECT_FALSE(sensitivity.ok()) << "pass " << i << ", after " << after;
        EXPECT_EQ(polls_left, -1) << "pass " << i << ", after " << after;
        const RolloutStatus& status = sensitivity.status();
        EXPECT_EQ(status.code, RolloutStatus::Code::kInterrupted);
        EXPECT_EQ(status.object, 0);
        if (memory_limit == 0) continue;  // steps that are taken again poll as well
        const bool backward = i == 0 || i == 2;
        const int step = backward ? 3 * (kFrames - 1) - 1 - after : after;
        EXPECT_EQ(status.frame, step / 3 + 1) << "pass " << i << ", after " << after;
        EXPECT_EQ(status.step, step % 3) << "pass " << i << ", after " << after;
        EXPECT_EQ(status.Message(),
                  "the derivative pass was interrupted in object 0 "
                  "on the way to frame " +
                      std::to_string(step / 3 + 1) + ", step " +
                      std::to_string(step % 3));
      }
      // The systems are as they were.
      polls_left = 1 << 30;
      Sensitivity sensitivity(&simulator, &rollout);
      passes[i](&sensitivity);
      EXPECT_TRUE(sensitivity.ok()) << "pass " << i;
      EXPECT_GE((1 << 30) - polls_left, 3 * (kFrames - 2)) << "pass " << i;
    }
  }
}

}  // namespace
}  // namespace dpe::test
