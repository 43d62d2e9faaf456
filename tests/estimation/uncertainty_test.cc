#include "dpe/estimation/uncertainty.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "support/test_scenes.h"
#include "uncertainty_io.h"
#include "uncertainty_support.h"

namespace dpe {
namespace {

using test::AnyContains;
using test::LinearProblem;
using test::RandomMatrix;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

Scene SceneOf(const std::string& settings) {
  Scene scene = test::MakeDerivativeScene("flag", 4);
  ApplySettings(settings, &scene);
  return scene;
}

// Mass, stiffness, damping, drag (one each) and wind: seven parameters.
LinearProblem SevenParameters() {
  Scene scene = SceneOf("GG");
  scene.objects[0].estimate_damping = scene.objects[0].estimate_drag = true;
  scene.estimate_wind = true;
  scene.wind = {3.0, 0.0, -4.0};
  return LinearProblem(scene);
}

// A random Jacobian whose products with the columns of `null` vanish.
Eigen::MatrixXd JacobianWithout(const Eigen::MatrixXd& null, int rows) {
  const int n = static_cast<int>(null.rows());
  const Eigen::MatrixXd q = Eigen::HouseholderQR<Eigen::MatrixXd>(null).householderQ() *
                            Eigen::MatrixXd::Identity(n, null.cols());
  const Eigen::MatrixXd random = RandomMatrix(rows, n, 3);
  return random - random * q * q.transpose();
}

Eigen::MatrixXd Columns(int rows, const std::vector<double>& values) {
  return Eigen::Map<const Eigen::MatrixXd>(values.data(), rows, values.size() / rows);
}

TEST(UncertaintyTest, AgreesWithAProblemSolvedByHand) {
  const LinearProblem problem(SceneOf("GG"));
  ASSERT_EQ(problem.size(), 2);
  // J^T J = (4 2; 2 2), whose inverse is (1/2 -1/2; -1/2 1).
  const Eigen::MatrixXd jacobian = Columns(2, {2, 0, 1, 1});
  const Uncertainty result = ComputeUncertainty(problem.Input(jacobian));
  ASSERT_TRUE(result.ok) << result.message;
  EXPECT_NEAR(result.covariance(0, 0), 0.5, 1e-14);
  EXPECT_NEAR(result.covariance(0, 1), -0.5, 1e-14);
  EXPECT_NEAR(result.covariance(1, 1), 1.0, 1e-14);
  EXPECT_NEAR(result.correlation(0, 1), -std::sqrt(0.5), 1e-14);
  // The delta method: the relative deviation times the value.
  const double stiffness = std::exp(problem.q[1]);
  EXPECT_NEAR(result.blocks[0].relative[0], std::sqrt(0.5), 1e-14);
  EXPECT_NEAR(result.blocks[1].standard_deviations[0], stiffness, 1e-12 * stiffness);
  EXPECT_NEAR(result.blocks[1].values[0], stiffness, 1e-12 * stiffness);
  EXPECT_EQ(result.blocks[1].unit, "N/m");
  EXPECT_EQ(result.blocks[1].determined_part, result.blocks[1].standard_deviations);
  EXPECT_EQ(result.rank, 2);
}

TEST(UncertaintyTest, APriorAddsItsInformation) {
  const LinearProblem problem(SceneOf("GG"));
  UncertaintyInput input = problem.Input(Columns(2, {2, 0, 1, 1}));
  input.prior_rows = Columns(1, {0, std::sqrt(2.0)});
  // J^T J + P^T P = (4 2; 2 4), whose inverse is (4 -2; -2 4) / 12.
  const Uncertainty result = ComputeUncertainty(input);
  EXPECT_NEAR(result.covariance(0, 0), 4.0 / 12.0, 1e-14);
  EXPECT_NEAR(result.covariance(1, 0), -2.0 / 12.0, 1e-14);
}

// Errors of estimates, over and over with new noise and new priors.
TEST(UncertaintyTest, AgreesWithMonteCarloOnALinearGaussianProblem) {
  const LinearProblem problem = SevenParameters();
  const int n = problem.size(), m = 20, num_samples = 20000;
  ASSERT_EQ(n, 7);
  Eigen::MatrixXd jacobian = 4.0 * RandomMatrix(m, n, 1);
  jacobian.col(2) *= 1e-3;  // damping: known from its prior
  Eigen::MatrixXd priors = Eigen::MatrixXd::Zero(2, n);
  priors(0, 2) = 5.0;
  priors.row(1) << 1, -1, 0, 2, 0, 0, 0.5;
  Eigen::MatrixXd stacked(m + 2, n);
  stacked << jacobian, priors;
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(stacked);

  UncertaintyInput input = problem.Input(jacobian);
  input.prior_rows = priors;
  const Uncertainty result = ComputeUncertainty(input);
  ASSERT_TRUE(result.ok);
  const Eigen::MatrixXd noise = RandomMatrix(m + 2, num_samples, 2);
  const Eigen::MatrixXd errors = qr.solve(noise);
  const Eigen::MatrixXd empirical = errors * errors.transpose() / num_samples;
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      // Entries of a sample covariance scatter by at most sqrt(2 C_ii C_jj / N).
      const double scatter = std::sqrt(2.0 * result.covariance(i, i) *
                                       result.covariance(j, j) / num_samples);
      EXPECT_NEAR(result.covariance(i, j), empirical(i, j), 5.0 * scatter);
    }
  }
  EXPECT_EQ(result.blocks[2].flags[0], kPriorAlone);
  EXPECT_NEAR(result.blocks[2].relative[0], 0.2, 1e-3);
  EXPECT_TRUE(AnyContains(result.statements,
                          "the damping of object 0 is determined by its prior alone"));
  EXPECT_EQ(result.blocks[0].flags[0], 0u);
  // Velocities have no relative deviation.
  EXPECT_TRUE(std::isnan(result.blocks[4].relative[0]));
  EXPECT_NEAR(result.blocks[4].standard_deviations[2],
              std::sqrt(result.covariance(6, 6)), 1e-14);
}

TEST(UncertaintyTest, UnknownNoiseIsTakenFromTheResiduals) {
  const LinearProblem problem = SevenParameters();
  const Eigen::MatrixXd jacobian = 4.0 * RandomMatrix(107, 7, 1);
  UncertaintyInput input = problem.Input(jacobian);
  const Uncertainty whitened = ComputeUncertainty(input);
  EXPECT_NEAR(whitened.reduced_chi_square, 1.07, 1e-12);
  EXPECT_EQ(whitened.noise, 1.0);
  // The same problem in metres, with noise of 3 mm.
  const double sigma = 0.003;
  input.data_triangle *= sigma;
  input.residual_sum_of_squares = sigma * sigma * 100;
  input.noise_is_known = false;
  const Uncertainty metres = ComputeUncertainty(input);
  EXPECT_NEAR(metres.noise, sigma, 1e-15);
  EXPECT_EQ(metres.degrees_of_freedom, 100);
  EXPECT_TRUE(std::isnan(metres.reduced_chi_square));
  EXPECT_LT((metres.covariance - whitened.covariance).norm(),
            1e-12 * whitened.covariance.norm());
  EXPECT_TRUE(AnyContains(metres.statements, "the residuals make it 0.003 m"));
  EXPECT_FALSE(AnyContains(whitened.statements, "noise"));
  // Priors are in their own deviations whatever the residuals are in.
  input.prior_rows = Eigen::MatrixXd::Identity(7, 7);
  const Eigen::MatrixXd expected =
      (whitened.covariance.inverse() + Eigen::MatrixXd::Identity(7, 7)).inverse();
  EXPECT_LT((ComputeUncertainty(input).covariance - expected).norm(),
            1e-12 * expected.norm());
}

TEST(UncertaintyTest, ResidualsThatDoNotFitTheNoiseAreReported) {
  const LinearProblem problem = SevenParameters();
  UncertaintyInput input = problem.Input(4.0 * RandomMatrix(1007, 7, 1));
  input.residual_sum_of_squares = 9000.0;
  EXPECT_TRUE(AnyContains(ComputeUncertainty(input).statements,
                          "3 times as large as the noise given"));
  input.residual_sum_of_squares = 250.0;
  EXPECT_TRUE(AnyContains(ComputeUncertainty(input).statements, "there is less noise"));
  input.residual_sum_of_squares = 1050.0;
  EXPECT_THAT(ComputeUncertainty(input).statements, IsEmpty());
}

TEST(UncertaintyTest, ErrorsThatLastAreToldFromNoise) {
  const LinearProblem problem = SevenParameters();
  UncertaintyInput input = problem.Input(4.0 * RandomMatrix(1007, 7, 1));
  input.num_residual_pairs = 1000;
  input.residual_correlation = 0.15;  // 1 / sqrt(1000) = 0.03
  EXPECT_EQ(ComputeUncertainty(input).residual_correlation, 0.0);
  input.residual_correlation = 0.6;
  const Uncertainty result = ComputeUncertainty(input);
  EXPECT_EQ(result.residual_correlation, 0.6);
  EXPECT_TRUE(AnyContains(result.statements, "correlated (0.6)"));
  EXPECT_TRUE(AnyContains(result.statements, "factor of about 2"));
}

TEST(UncertaintyTest, SaysWhatWasDetermined) {
  const LinearProblem problem = SevenParameters();
  Eigen::MatrixXd jacobian = 4.0 * RandomMatrix(1007, 7, 1);
  EXPECT_EQ(DeterminedText(ComputeUncertainty(problem.Input(jacobian))),
            "all 7 parameters were determined");
  jacobian.col(2) *= 1e-4;
  const Uncertainty result = ComputeUncertainty(problem.Input(jacobian));
  EXPECT_EQ(DeterminedText(result),
            "6 of 7 parameters were determined, not or hardly " + result.names[2]);
}

struct PatternCase {
  friend void PrintTo(const PatternCase& c, std::ostream* out) { *out << c.text; }

  std::vector<double> null;  // columns
  DirectionPattern pattern;
  std::string text;  // of the last direction
};

class UncertaintyPatternTest : public ::testing::TestWithParam<PatternCase> {};

TEST_P(UncertaintyPatternTest, NamesExactDirections) {
  const LinearProblem problem = SevenParameters();
  const Eigen::MatrixXd null = Columns(7, GetParam().null);
  const Uncertainty result =
      ComputeUncertainty(problem.Input(50.0 * JacobianWithout(null, 30)));
  ASSERT_TRUE(result.ok) << result.message;
  EXPECT_EQ(result.rank, 7 - null.cols());
  ASSERT_EQ(static_cast<int>(result.directions.size()), null.cols());
  const UndeterminedDirection& last = result.directions.back();
  EXPECT_EQ(last.pattern, GetParam().pattern) << last.text;
  EXPECT_EQ(last.text, GetParam().text);
  EXPECT_TRUE(last.is_exact);
  EXPECT_EQ(last.std, kInfinity);
  // Parameters with a part in it, and no others, are undetermined.
  int j = 0;
  for (const BlockUncertainty& block : result.blocks) {
    for (size_t k = 0; k < block.flags.size(); ++k, ++j) {
      const bool takes_part = null.row(j).norm() > 0.0;
      EXPECT_EQ(std::isinf(block.standard_deviations[k]), takes_part) << j;
      EXPECT_EQ((block.flags[k] & kUndetermined) != 0, takes_part) << j;
      EXPECT_TRUE(std::isfinite(block.determined_part[k])) << j;
      EXPECT_EQ(std::isnan(result.correlation(j, j)), takes_part) << j;
    }
  }
}

// Order: mass, stiffness, damping, drag, wind; the wind's natural unit is 4 m/s.
INSTANTIATE_TEST_SUITE_P(
    Patterns, UncertaintyPatternTest,
    ::testing::Values(
        PatternCase{{1, 1, 0, 0, 0, 0, 0},
                    DirectionPattern::kRatio,
                    "mass and stiffness of object 0 scale together: only their ratio "
                    "was determined"},
        PatternCase{{1, 1, 0, 1, 0, 0, 0},
                    DirectionPattern::kRatio,
                    "mass, stiffness and drag of object 0 scale together: only their "
                    "ratios were determined"},
        PatternCase{{0, 1, -1, 0, 0, 0, 0},
                    DirectionPattern::kProduct,
                    "stiffness and damping of object 0 change against each other: only "
                    "their product was determined"},
        PatternCase{{0, 0, 0, 1, -3, 0, 4},
                    DirectionPattern::kProduct,
                    "the drag of object 0 and the wind strength change against each "
                    "other: only their product was determined"},
        PatternCase{{1, 1, -0.5, 0, 0, 0, 0},
                    DirectionPattern::kBlocks,
                    "changing the mass of object 0 by +1 %, the stiffness of object 0 "
                    "by +1 % and the damping of object 0 by -0.5 % together has no "
                    "effect on what was observed"},
        PatternCase{{0, 0, 1, 0, 0, 0, 0},
                    DirectionPattern::kSingle,
                    "the damping of object 0 has no effect on what was observed"},
        PatternCase{{0, 0, 0, 0, 4, 4, 0},
                    DirectionPattern::kElements,
                    "changing the wind along x by +0.04 m/s and the wind along y by "
                    "+0.04 m/s together has no effect on what was observed"},
        // Several at once, however they are mixed.
        PatternCase{{1, 1, 3, 0, 0, 0, 0, -1, -1, 2, 0, 0, 0, 0},
                    DirectionPattern::kRatio,
                    "mass and stiffness of object 0 scale together: only their ratio "
                    "was determined"},
        PatternCase{{1, 1, 0, 2, -3, 0, 4, 2, 2, 0, 1, 3, 0, -4},
                    DirectionPattern::kProduct,
                    "the drag of object 0 and the wind strength change against each "
                    "other: only their product was determined"}));

TEST(UncertaintyTest, WhatIsOrthogonalToTheNullSpaceKeepsItsDeviation) {
  const LinearProblem problem = SevenParameters();
  const Eigen::MatrixXd null = Columns(7, {1, 1, 0, 1, 0, 0, 0});
  const Eigen::MatrixXd jacobian = 10.0 * JacobianWithout(null, 30);
  const Uncertainty result = ComputeUncertainty(problem.Input(jacobian));
  // Mass held: the same problem without its column.
  const Eigen::MatrixXd held = jacobian.rightCols(6);
  const Eigen::MatrixXd covariance = (held.transpose() * held).inverse();
  EXPECT_NEAR(result.blocks[2].relative[0], std::sqrt(covariance(1, 1)), 1e-12);
  EXPECT_NEAR(result.covariance(5, 6), covariance(4, 5), 1e-12);
  // The pseudo-inverse by another way; no velocity takes part, so that it does not
  // matter what these are measured in.
  const Eigen::MatrixXd normal = jacobian.transpose() * jacobian;
  const Eigen::MatrixXd v = null.normalized();
  const Eigen::MatrixXd n = Eigen::MatrixXd::Identity(7, 7) - v * v.transpose();
  EXPECT_LT((n * (normal + v * v.transpose()).inverse() * n - result.covariance).norm(),
            1e-10 * result.covariance.norm());
}

TEST(UncertaintyTest, APriorThatFixesAScaleIsSaidToBeAlone) {
  const LinearProblem problem = SevenParameters();
  UncertaintyInput input =
      problem.Input(50.0 * JacobianWithout(Columns(7, {1, 1, 0, 0, 0, 0, 0}), 30));
  input.prior_rows = Eigen::RowVectorXd::Unit(7, 0) * 10.0;  // mass to 10 %
  const Uncertainty result = ComputeUncertainty(input);
  EXPECT_EQ(result.rank, 6);
  EXPECT_EQ(result.blocks[0].flags[0], kPriorAlone);
  EXPECT_NEAR(result.blocks[0].relative[0], 0.1, 1e-10);
  EXPECT_NEAR(result.blocks[1].relative[0], 0.1, 0.01);
  ASSERT_EQ(result.directions.size(), 1u);
  EXPECT_EQ(result.directions[0].data_std, kInfinity);
  EXPECT_NEAR(result.directions[0].std, 0.1, 0.01);
  EXPECT_THAT(result.directions[0].text, HasSubstr("the prior fixes it to 10"));
}

TEST(UncertaintyTest, WeakDirectionsAreNamedWithTheirSpread) {
  const LinearProblem problem = SevenParameters();
  const Eigen::MatrixXd scale = Columns(7, {1, 1, 0, 0, 0, 0, 0});
  Eigen::MatrixXd jacobian(31, 7);
  jacobian << 500.0 * JacobianWithout(scale, 30), 0.25 * scale.transpose();
  const Uncertainty result = ComputeUncertainty(problem.Input(jacobian));
  // A factor t of both is seen as 0.25 * 2 t.
  ASSERT_EQ(result.directions.size(), 1u);
  const UndeterminedDirection& direction = result.directions[0];
  EXPECT_FALSE(direction.is_exact);
  EXPECT_NEAR(direction.data_std, 2.0, 1e-3);
  EXPECT_EQ(direction.pattern, DirectionPattern::kRatio);
  EXPECT_THAT(direction.text,
              HasSubstr("a common factor is known only to a factor of 7.39"));
  EXPECT_EQ(result.blocks[0].flags[0], kWeaklyDetermined);
  EXPECT_EQ(result.blocks[2].flags[0], 0u);
  EXPECT_NEAR(result.blocks[0].relative[0], 2.0, 1e-3);
  EXPECT_EQ(result.rank, 7);
  EXPECT_THAT(result.strongest_pairs, testing::SizeIs(1));
  EXPECT_TRUE(AnyContains(result.statements, "are correlated: 1"));
}

// Rounding errors of a column are of the size of that column.
TEST(UncertaintyTest, ColumnsOfVeryDifferentLengthsAreNotTakenForNothing) {
  const LinearProblem problem = SevenParameters();
  Eigen::MatrixXd jacobian = 1e15 * RandomMatrix(30, 7, 5);
  const Eigen::MatrixXd even = ComputeUncertainty(problem.Input(jacobian)).covariance;
  jacobian.col(3) *= 1e-13;
  const Uncertainty result = ComputeUncertainty(problem.Input(jacobian));
  EXPECT_EQ(result.rank, 7);
  EXPECT_NEAR(result.covariance(3, 3) * 1e-26, even(3, 3), 1e-8 * even(3, 3));
  EXPECT_NEAR(result.covariance(2, 2), even(2, 2), 1e-8 * even(2, 2));
}

TEST(UncertaintyTest, ParametersThatWentToAnEndOfTheirRange) {
  Scene scene = SceneOf("nR");
  scene.objects[0].estimate_drag = true;
  LinearProblem problem(scene);
  ASSERT_EQ(problem.size(), 4);
  problem.q[1] = std::log(1e-11);
  problem.q[3] = std::log(1e12);
  Eigen::MatrixXd jacobian = 100.0 * RandomMatrix(30, 4, 5);
  jacobian.col(1) *= 1e-6;
  jacobian.col(3) *= 1e-6;
  const Uncertainty result = ComputeUncertainty(problem.Input(jacobian));
  const auto& flags = result.blocks[0].flags;
  EXPECT_EQ(flags[0], 0u);
  EXPECT_EQ(flags[1], kWeaklyDetermined | kAtLowerLimit);
  EXPECT_EQ(result.blocks[1].flags[0], kWeaklyDetermined | kAtUpperLimit);
  EXPECT_THAT(ParameterFlagNames(flags[1]),
              ElementsAre("weakly_determined", "at_lower_limit"));
  EXPECT_TRUE(
      AnyContains(result.statements,
                  "the shear stiffness of object 0 went to the lower end of its "
                  "range (1e-11 N/m): zero explains what was observed as well"));
  EXPECT_TRUE(AnyContains(result.statements, "the drag of object 0 went to the upper"));
}

TEST(UncertaintyTest, ManyParametersAgreeWithTheInverse) {
  Scene scene = test::MakeDerivativeScene("side", 9);
  ApplySettings("LL", &scene);
  const LinearProblem problem(scene);
  const int n = problem.size();
  ASSERT_GT(n, 400);
  const Eigen::MatrixXd jacobian = RandomMatrix(2 * n, n, 7);
  const Uncertainty result = ComputeUncertainty(problem.Input(jacobian));
  ASSERT_TRUE(result.ok);
  EXPECT_EQ(result.covariance.size(), 0);
  EXPECT_THAT(result.directions, IsEmpty());
  const Eigen::MatrixXd covariance = (jacobian.transpose() * jacobian).inverse();
  for (int k = 0; k < result.blocks[0].values.size(); ++k) {
    EXPECT_NEAR(result.blocks[0].relative[k], std::sqrt(covariance(k, k)), 1e-10);
  }
}

TEST(UncertaintyTest, ManyUndeterminedParametersShareASentence) {
  Scene scene = test::MakeDerivativeScene("side", 9);
  ApplySettings("nL", &scene);
  const LinearProblem problem(scene);
  const int n = problem.size();
  Eigen::MatrixXd jacobian = 10.0 * RandomMatrix(2 * n, n, 7);
  jacobian.middleCols(5, 40).setZero();
  jacobian.middleCols(100, 30) *= 1e-4;
  const Uncertainty result = ComputeUncertainty(problem.Input(jacobian));
  EXPECT_EQ(result.rank, n - 40);
  EXPECT_EQ(result.num_weak_directions, 30);
  EXPECT_EQ(result.directions.size(), 40u);  // twenty of each kind
  EXPECT_TRUE(AnyContains(result.statements, "and 37 more of the " + std::to_string(n) +
                                                 " unknowns of the stiffness have no "
                                                 "effect on what was observed"));
  EXPECT_TRUE(AnyContains(result.statements, "and 27 more of the"));
  EXPECT_LT(result.statements.size(), 8u);
  const std::vector<std::string> lines = UncertaintyLines(result);
  EXPECT_THAT(lines[0], HasSubstr("40 not determined"));
  EXPECT_EQ(lines.size(), result.statements.size() + 2);
}

TEST(UncertaintyTest, LinesAndJsonSayTheSame) {
  const LinearProblem problem = SevenParameters();
  const Uncertainty result = ComputeUncertainty(
      problem.Input(100.0 * JacobianWithout(Columns(7, {1, 1, 0, 0, 0, 0, 0}), 30)));
  const std::vector<std::string> lines = UncertaintyLines(result);
  EXPECT_THAT(lines[0], HasSubstr("the mass of object 0: "));
  EXPECT_THAT(lines[0], HasSubstr(" kg (not determined; +- "));
  EXPECT_THAT(lines[2],
              testing::ContainsRegex("the damping of object 0: .* \\+- .* 1/s"));
  EXPECT_TRUE(AnyContains(lines, "scale together"));
  // Through text, as the report goes.
  const auto json = nlohmann::json::parse(UncertaintyToJson(result).dump());
  EXPECT_TRUE(json["ok"]);
  EXPECT_EQ(json["rank"], 6);
  EXPECT_TRUE(json["parameters"][0]["standard_deviations"][0].is_null());
  EXPECT_EQ(json["parameters"][2]["standard_deviations"][0],
            result.blocks[2].standard_deviations[0]);
  EXPECT_EQ(json["parameters"][0]["flags"][0]["names"][0], "undetermined");
  EXPECT_EQ(json["directions"][0]["pattern"], "ratio");
  EXPECT_EQ(json["directions"][0]["parts"][1]["name"], "the stiffness of object 0");
  EXPECT_EQ(json["correlation"].size(), 7u);
  EXPECT_TRUE(json["correlation"][0][0].is_null());
  EXPECT_EQ(json["correlation"][5][5], 1.0);
}

TEST(UncertaintyTest, InputThatDoesNotFitIsRefusedWithAReason) {
  const LinearProblem problem = SevenParameters();
  const UncertaintyInput good = problem.Input(RandomMatrix(30, 7, 1));
  const auto message = [](const UncertaintyInput& input,
                          const UncertaintyOptions& options = {}) {
    const Uncertainty result = ComputeUncertainty(input, options);
    EXPECT_FALSE(result.ok);
    EXPECT_THAT(result.blocks, IsEmpty());
    EXPECT_EQ(UncertaintyLines(result)[0], result.message);
    EXPECT_FALSE(UncertaintyToJson(result)["ok"]);
    return result.message;
  };
  EXPECT_TRUE(ComputeUncertainty(good).ok);
  UncertaintyInput input = good;
  input.data_triangle(2, 3) = std::nan("");
  EXPECT_THAT(message(input), HasSubstr("not finite"));
  input = good;
  input.residual_sum_of_squares = kInfinity;
  EXPECT_THAT(message(input), HasSubstr("not finite"));
  input = good;
  input.data_triangle.resize(6, 6);
  EXPECT_THAT(message(input), HasSubstr("the layout's 7 parameters"));
  input = good;
  input.prior_rows.setZero(1, 6);
  EXPECT_THAT(message(input), HasSubstr("the layout's 7 parameters"));
  UncertaintyOptions options;
  options.max_parameters = 6;
  EXPECT_THAT(message(good, options), HasSubstr("7 parameters are more than"));
  EXPECT_THAT(message(UncertaintyInput()), HasSubstr("no scene"));
}

TEST(UncertaintyTest, FewerResidualsThanParameters) {
  const LinearProblem problem = SevenParameters();
  UncertaintyInput input = problem.Input(RandomMatrix(5, 7, 1));
  Uncertainty result = ComputeUncertainty(input);
  EXPECT_TRUE(result.ok);
  EXPECT_EQ(result.rank, 5);
  EXPECT_EQ(result.directions.size(), 2u + result.num_weak_directions);
  input.noise_is_known = false;
  result = ComputeUncertainty(input);
  EXPECT_FALSE(result.ok);
  EXPECT_THAT(result.message, HasSubstr("5 residuals for 5 determined directions"));
  EXPECT_EQ(result.directions.size(), 2u);
  EXPECT_EQ(UncertaintyLines(result).size(), 3u);
}

TEST(UncertaintyTest, NoResidualsAtAllDetermineNothing) {
  const LinearProblem problem = SevenParameters();
  const Uncertainty result =
      ComputeUncertainty(problem.Input(Eigen::MatrixXd::Zero(0, 7)));
  EXPECT_TRUE(result.ok);
  EXPECT_EQ(result.rank, 0);
  EXPECT_EQ(result.directions.size(), 7u);
  for (const BlockUncertainty& block : result.blocks) {
    EXPECT_TRUE((block.standard_deviations.array() == kInfinity).all());
  }
}

}  // namespace
}  // namespace dpe
