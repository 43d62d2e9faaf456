// What the tests of uncertainty share: linear problems on small layouts, and the
// triangle of a real Jacobian.
#ifndef DPE_TESTS_ESTIMATION_UNCERTAINTY_SUPPORT_H_
#define DPE_TESTS_ESTIMATION_UNCERTAINTY_SUPPORT_H_

#include <Eigen/Dense>
#include <algorithm>
#include <random>
#include <string>
#include <vector>

#include "dpe/engine/parameters.h"
#include "dpe/engine/scene.h"
#include "dpe/estimation/trajectory_evaluator.h"
#include "dpe/estimation/uncertainty.h"

namespace dpe::test {

inline Eigen::MatrixXd RandomMatrix(int rows, int cols, unsigned seed) {
  std::mt19937 generator(seed);
  std::normal_distribution<double> normal;
  Eigen::MatrixXd matrix(rows, cols);
  for (int j = 0; j < cols; ++j) {
    for (int i = 0; i < rows; ++i) matrix(i, j) = normal(generator);
  }
  return matrix;
}

// R with R^T R = J^T J.
inline Eigen::MatrixXd TriangleOf(const Eigen::MatrixXd& jacobian) {
  const int n = static_cast<int>(jacobian.cols());
  Eigen::MatrixXd tall = Eigen::MatrixXd::Zero(std::max<long>(jacobian.rows(), n), n);
  tall.topRows(jacobian.rows()) = jacobian;
  return Eigen::HouseholderQR<Eigen::MatrixXd>(tall)
      .matrixQR()
      .topRows(n)
      .triangularView<Eigen::Upper>();
}

// A linear problem in the parameters of a scene, about the scene's own values.
struct LinearProblem {
  explicit LinearProblem(Scene the_scene)
      : scene(std::move(the_scene)),
        layout(scene),
        q(ParameterMap(layout).ToCoordinates(layout.Extract(scene))) {}

  int size() const { return layout.size(); }

  UncertaintyInput Input(const Eigen::MatrixXd& jacobian) const {
    UncertaintyInput input;
    input.scene = &scene;
    input.layout = &layout;
    input.coordinates = q;
    input.data_triangle = TriangleOf(jacobian);
    input.num_residuals = jacobian.rows();
    input.residual_sum_of_squares = static_cast<double>(jacobian.rows());
    input.noise_is_known = true;
    return input;
  }

  Scene scene;
  ParameterLayout layout;
  Eigen::VectorXd q;
};

inline bool AnyContains(const std::vector<std::string>& texts,
                        const std::string& part) {
  return std::any_of(texts.begin(), texts.end(), [&](const std::string& text) {
    return text.find(part) != std::string::npos;
  });
}

}  // namespace dpe::test

#endif  // DPE_TESTS_ESTIMATION_UNCERTAINTY_SUPPORT_H_
