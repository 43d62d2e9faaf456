// Priors as rows: values, derivatives, whom they are about, and what a weight means.
#include "prior_rows.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <random>

#include "ceres_support.h"
#include "dpe/engine/cloth_builder.h"
#include "dpe/engine/simulator.h"
#include "dpe/estimation/parameterization.h"
#include "dpe/estimation/trajectory_problem.h"
#include "neighbours.h"
#include "support/derivative_checker.h"
#include "support/test_scenes.h"

namespace dpe {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

Scene SceneOf(const std::string& settings, int resolution = 5) {
  Scene scene = test::MakeDerivativeScene("side", resolution);
  ApplySettings(settings, &scene);
  return scene;
}

Eigen::VectorXd Residuals(const PriorRows& rows, const Eigen::VectorXd& q) {
  Eigen::VectorXd r(rows.size());
  for (int i = 0; i < rows.size(); ++i) r[i] = rows.rows()[i].Residual(q.data(), 0);
  return r;
}

PriorRows RowsOf(const Scene& scene, const std::string& priors,
                 const std::string& smoothness) {
  return PriorRows(scene, ParameterLayout(scene), PriorsFromText(priors),
                   SmoothnessFromText(smoothness));
}

std::string ErrorOf(const Scene& scene, const std::string& priors,
                    const std::string& smoothness) {
  try {
    RowsOf(scene, priors, smoothness);
  } catch (const SceneError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(PriorRowsTest, ValuesAreDistancesFromTheCentreInSpreads) {
  Scene scene = SceneOf("nG");
  scene.objects[0].estimate_damping = true;
  scene.estimate_wind = true;
  const PriorRows rows = RowsOf(
      scene, "stiffness:lognormal:50,0.5;damping:normal:0.1,0.02;wind:normal:1,4", "");
  Eigen::VectorXd p(5);
  p << 50.0 * std::exp(1.0), 0.16, 1.0, 9.0, -3.0;
  const ParameterMap map{ParameterLayout(scene)};
  const Eigen::VectorXd q = map.ToCoordinates(p);
  Eigen::VectorXd expected(5);
  expected << 2.0, 3.0, 0.0, 2.0, -1.0;
  EXPECT_LT((Residuals(rows, q) - expected).norm(), 1e-12);
  EXPECT_NEAR(rows.Cost(q), 0.5 * expected.squaredNorm(), 1e-12);
}

TEST(PriorRowsTest, PartsAreThoseOfTheirName) {
  const Scene grouped = SceneOf("nR");
  const PriorRows shear = RowsOf(grouped, "stiffness[shear]:lognormal:50,0.5", "");
  ASSERT_EQ(shear.size(), 1);
  EXPECT_EQ(shear.rows()[0].a, static_cast<int>(SpringKind::kShear));
  const Scene local = SceneOf("LL");
  const ParameterLayout layout(local);
  const ParameterBlock& stiffness = layout.blocks()[1];
  const PriorRows bend = RowsOf(local, "stiffness[bend]:normal:50,5", "");
  int count = 0;
  for (int s = 0; s < local.objects[0].num_springs(); ++s) {
    const bool is_bend = local.objects[0].spring_kind[s] == SpringKind::kBend;
    if (!is_bend || stiffness.element_to_local[s] < 0) continue;
    EXPECT_EQ(bend.rows()[count++].a, stiffness.offset + stiffness.element_to_local[s]);
  }
  EXPECT_EQ(bend.size(), count);
  EXPECT_GT(count, 10);
  Scene moving = SceneOf("nn");
  moving.objects[0].estimate_initial_velocity = true;
  const PriorRows along_y = RowsOf(moving, "initial_velocity[y]:normal:0,1", "");
  ASSERT_EQ(along_y.size(), ParameterLayout(moving).size() / 3);
  for (const PriorRows::Row& row : along_y.rows()) EXPECT_EQ(row.a % 3, 1);
}

TEST(PriorRowsTest, APriorOnNothingThatIsEstimatedIsRefused) {
  const Scene scene = SceneOf("nG");
  const std::string drag = "drag:lognormal:0.1,1";
  EXPECT_THAT(ErrorOf(scene, drag, ""),
              AllOf(HasSubstr("prior \"" + drag + "\""), HasSubstr("not estimated"),
                    HasSubstr("stiffness of object 0")));
  EXPECT_THAT(ErrorOf(scene, "stiffness@1:normal:1,1", ""), HasSubstr("@1"));
  EXPECT_THAT(ErrorOf(scene, "stiffness:normal:50,0", ""),
              AllOf(HasSubstr("spread"), HasSubstr("N/m")));
  EXPECT_THAT(ErrorOf(scene, "stiffness:normal:50,-1", ""), HasSubstr("spread"));
  EXPECT_THAT(ErrorOf(scene, "stiffness:lognormal:0,1", ""),
              AllOf(HasSubstr("centre"), HasSubstr("median in N/m")));
  EXPECT_THAT(ErrorOf(scene, "stiffness[shear]:normal:50,1", ""),
              AllOf(HasSubstr("one value for \"shear\" and others (mode G)"),
                    HasSubstr("mode R or L")));
  EXPECT_THAT(ErrorOf(SceneOf("nR"), "stiffness[7]:normal:50,1", ""),
              HasSubstr("of \"7\""));
  Scene windy = scene;
  windy.estimate_wind = true;
  EXPECT_THAT(ErrorOf(windy, "wind:lognormal:5,1", ""),
              HasSubstr("positive by nature"));
  EXPECT_THAT(ErrorOf(scene, "", "stiffness=10"),
              AllOf(HasSubstr("smoothness \"stiffness=10\""), HasSubstr("(mode L)")));
  EXPECT_THAT(ErrorOf(SceneOf("nL"), "", "mass=10"),
              HasSubstr("stiffness of object 0"));
  EXPECT_EQ(ErrorOf(SceneOf("LL"), "", "mass=10,stiffness=1"), "accepted");
}

TEST(PriorRowsTest, DerivativesAgreeWithDifferences) {
  Scene scene = test::MakeDerivativeScene("two_objects", 4);
  test::Perturb(3, &scene);
  test::EstimateEverything(ParameterMode::kLocal, &scene);
  const ParameterLayout layout(scene);
  const PriorRows rows =
      RowsOf(scene,
             "stiffness:lognormal:50,0.5;stiffness@1:normal:20,5;mass:normal:0.1,0.02;"
             "wind:normal:1,2;initial_velocity[z]:normal:0,0.5;drag:lognormal:0.1,0.3",
             "stiffness=30,mass=4");
  const Eigen::VectorXd q = ParameterMap(layout).ToCoordinates(layout.Extract(scene));
  Eigen::VectorXd gradient = Eigen::VectorXd::Zero(q.size());
  rows.AddGradient(q, &gradient);
  const Eigen::VectorXd direction = test::RandomVector(layout.size(), 4);
  const auto check = test::CheckDirectionalDerivative(
      [&](const Eigen::VectorXd& x) {
        return Eigen::VectorXd::Constant(1, rows.Cost(x));
      },
      q, direction, Eigen::VectorXd::Constant(1, gradient.dot(direction)));
  EXPECT_LT(check.relative_error, 1e-9) << check;
  const Eigen::MatrixXd triangle = rows.Triangle(q, 1);
  EXPECT_EQ(triangle.rows(), layout.size());  // fewer than there are rows
  const auto product = test::CheckDirectionalDerivative(
      [&](const Eigen::VectorXd& x) { return Residuals(rows, x); }, q, direction,
      [&] {
        Eigen::VectorXd dr(rows.size());
        for (int i = 0; i < rows.size(); ++i) {
          const PriorRows::Row& row = rows.rows()[i];
          dr[i] = row.Slope(q.data(), 0) * direction[row.a];
          if (row.b >= 0) dr[i] -= row.scale * direction[row.b];
        }
        return dr;
      }());
  EXPECT_LT(product.relative_error, 1e-9) << product;
  EXPECT_NEAR((triangle * direction).norm(), product.numeric.norm(),
              1e-8 * product.numeric.norm());
}

// All three ways to the cost, with the priors as parts of it.
TEST(PriorRowsTest, ProblemGradientAndJacobianKnowThePriors) {
  Scene scene = SceneOf("LL", 4);
  scene.objects[0].estimate_damping = true;
  test::Perturb(3, &scene);
  Scene other = scene;
  test::Perturb(5, &other);
  TrajectoryEvaluatorOptions options;
  options.priors = PriorsFromText("stiffness:lognormal:9,0.01;damping:normal:3,0.1");
  options.smoothness = SmoothnessFromText("stiffness=2000,mass=500");
  TrajectoryProblem problem(
      scene, MakePositionCosts(scene, ObserveAll(Simulator(other).Simulate(8)), 8),
      options);
  TrajectoryEvaluator* evaluator = problem.evaluator();
  const Eigen::VectorXd q =
      evaluator->map().ToCoordinates(evaluator->layout().Extract(scene));
  const Eigen::VectorXd direction = test::RandomVector(static_cast<int>(q.size()), 9);
  const Eigen::VectorXd times = test::CeresJacobianTimes(&problem, q, direction);
  const auto check = test::CheckDirectionalDerivative(
      [&](const Eigen::VectorXd& x) { return test::CeresResiduals(&problem, x); }, q,
      direction, times);
  EXPECT_LT(check.relative_error, 1e-6) << check;
  ASSERT_TRUE(evaluator->Evaluate(q));
  EXPECT_GT(evaluator->prior_cost(), 10.0 * evaluator->data_cost());
  EXPECT_NEAR(test::CeresResiduals(&problem, q).squaredNorm(), 2.0 * evaluator->cost(),
              1e-10 * evaluator->cost());
  double horizon_cost = 0.0;
  Eigen::VectorXd gradient;
  ASSERT_TRUE(evaluator->EvaluateGradient(&gradient));
  const double by_rows = test::CeresResiduals(&problem, q).dot(times);
  EXPECT_NEAR(gradient.dot(direction), by_rows, 1e-8 * std::abs(by_rows));
  ASSERT_TRUE(evaluator->CostOverHorizon(q, 8, &horizon_cost));
  ASSERT_TRUE(evaluator->Evaluate(q));
  EXPECT_NEAR(horizon_cost, evaluator->cost(), 1e-10 * horizon_cost);
  // Rotated, the problem is the same.
  const auto reduced = problem.NewReducedLeastSquares();
  ASSERT_NE(reduced, nullptr);
  const Eigen::MatrixXd full =
      test::Dense(test::CeresJacobian(&problem, problem.least_squares(), q));
  // Its parameter blocks are pieces of the same memory, in the order of the layout.
  ceres::Problem::EvaluateOptions in_order;
  reduced->GetParameterBlocks(&in_order.parameter_blocks);
  std::sort(in_order.parameter_blocks.begin(), in_order.parameter_blocks.end());
  ceres::CRSMatrix rotated;
  ASSERT_TRUE(reduced->Evaluate(in_order, nullptr, nullptr, nullptr, &rotated));
  const Eigen::MatrixXd small = test::Dense(rotated);
  EXPECT_LT(small.rows(), full.rows());
  EXPECT_LT((small.transpose() * small - full.transpose() * full).norm(),
            1e-10 * (full.transpose() * full).norm());
}

TEST(PriorRowsTest, TheBestPointIsThatOfTheTotalCost) {
  const Scene scene = SceneOf("nG");
  TrajectoryEvaluatorOptions options;
  options.priors = PriorsFromText("stiffness:lognormal:60,1e-4");
  TrajectoryEvaluator evaluator(
      scene, MakePositionCosts(scene, ObserveAll(Simulator(scene).Simulate(8)), 8),
      options);
  const Eigen::VectorXd truth =
      evaluator.map().ToCoordinates(evaluator.layout().Extract(scene));
  const Eigen::VectorXd centre = Eigen::VectorXd::Constant(1, std::log(60.0));
  ASSERT_TRUE(evaluator.Evaluate(centre));
  const double data_cost = evaluator.data_cost(), cost = evaluator.cost();
  ASSERT_TRUE(evaluator.Evaluate(truth));
  EXPECT_LT(evaluator.data_cost(), data_cost);
  EXPECT_GT(evaluator.cost(), cost);
  EXPECT_EQ(evaluator.best_coordinates(), centre);
  EXPECT_EQ(evaluator.best_cost(), cost);
}

// The mean variance of the logarithm of neighbours' ratio is 1 / w, whatever the mesh.
TEST(PriorRowsTest, TheWeightIsOneOverTheVarianceOfNeighbours) {
  for (const char* what : {"stiffness=4", "mass=4"}) {
    for (const int resolution : {4, 7}) {
      SCOPED_TRACE(std::string(what) + " " + std::to_string(resolution));
      const Scene scene = SceneOf(what[0] == 'm' ? "Ln" : "nL", resolution);
      const PriorRows rows = RowsOf(scene, "", what);
      const int n = ParameterLayout(scene).size();
      const Eigen::MatrixXd p = rows.Triangle(Eigen::VectorXd::Zero(n), 1);
      const Eigen::MatrixXd covariance = Eigen::MatrixXd(p.transpose() * p)
                                             .completeOrthogonalDecomposition()
                                             .pseudoInverse();
      double sum = 0.0;
      for (const PriorRows::Row& row : rows.rows()) {
        sum += covariance(row.a, row.a) + covariance(row.b, row.b) -
               2.0 * covariance(row.a, row.b);
      }
      EXPECT_NEAR(sum / rows.size(), 1.0 / 4.0, 1e-9);
    }
  }
}

TEST(PriorRowsTest, NeighboursAreOfOneKindAndTouch) {
  const ClothObject cloth = SceneOf("nL", 5).objects[0];
  const Neighbours neighbours = FindNeighbours(cloth, ParameterKind::kStiffness);
  int touching[3] = {0, 0, 0}, apart[3] = {0, 0, 0};
  for (const auto& [a, b] : neighbours.pairs) {
    EXPECT_LT(a, b);
    EXPECT_EQ(cloth.spring_kind[a], cloth.spring_kind[b]);
    int common = 0;
    for (const int i : cloth.springs[a]) {
      for (const int j : cloth.springs[b]) common += i == j;
    }
    touching[static_cast<int>(cloth.spring_kind[a])] += common;
    apart[static_cast<int>(cloth.spring_kind[a])] += common == 0;
  }
  // 4 edges meet within the cloth, 3 on the boundary, 2 at a corner; two diagonals
  // touch within, and those of different lines are joined all the same.
  EXPECT_EQ(touching[0], 9 * 6 + 12 * 3 + 4 * 1);
  EXPECT_EQ(apart[0], 0);
  EXPECT_EQ(touching[1], 9);
  EXPECT_GT(apart[1], 9);
  EXPECT_EQ(FindNeighbours(cloth, ParameterKind::kMass).pairs.size(),
            static_cast<size_t>(cloth.num_springs()));
}

// All that a smoothness prior leaves free is one factor for each kind of spring.
TEST(PriorRowsTest, EachKindOfSpringIsOnePiece) {
  for (const int resolution : {4, 5, 8}) {
    const Scene scene = SceneOf("nL", resolution);
    const int n = ParameterLayout(scene).size();
    const Eigen::MatrixXd p =
        RowsOf(scene, "", "stiffness=1").Triangle(Eigen::VectorXd::Zero(n), 1);
    EXPECT_EQ(Eigen::MatrixXd(p.transpose() * p).fullPivLu().rank(), n - 3);
  }
}

// A uniform material is perfectly smooth, though boundary springs have half of it.
TEST(PriorRowsTest, AUniformMaterialCostsNothing) {
  for (const bool with_kinds : {true, false}) {
    Scene scene = SceneOf("LL", 6);
    if (!with_kinds) scene.objects[0].spring_kind.clear();  // as legacy files
    const ParameterLayout layout(scene);
    const PriorRows rows = RowsOf(scene, "", "stiffness=100,mass=100");
    const Eigen::VectorXd q = ParameterMap(layout).ToCoordinates(layout.Extract(scene));
    EXPECT_LT(rows.Cost(q), 1e-20);
    EXPECT_GT(rows.Cost(Eigen::VectorXd::Zero(q.size())), 1.0);
  }
  // Springs that are not the construction rule's are taken as they are.
  Scene scene = SceneOf("nL", 6);
  scene.objects[0].springs.push_back({0, 35});
  scene.objects[0].stiffness.conservativeResize(scene.objects[0].num_springs());
  scene.objects[0].stiffness.tail<1>().setConstant(1.0);
  scene.objects[0].spring_kind.push_back(SpringKind::kBend);
  EXPECT_EQ(RowsOf(scene, "", "stiffness=100")
                .Cost(Eigen::VectorXd::Constant(ParameterLayout(scene).size(), 2.0)),
            0.0);
}

}  // namespace
}  // namespace dpe
