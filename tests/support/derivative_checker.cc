#include "support/derivative_checker.h"

#include <random>

namespace dpe::test {

Eigen::VectorXd RandomVector(int size, unsigned seed) {
  std::mt19937 generator(seed);
  std::normal_distribution<double> normal;
  Eigen::VectorXd result(size);
  for (double& value : result) value = normal(generator);
  return result;
}

}  // namespace dpe::test
