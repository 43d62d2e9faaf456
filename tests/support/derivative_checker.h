// The finite-difference checker as the tests use it, with random directions.
#ifndef DPE_TESTS_SUPPORT_DERIVATIVE_CHECKER_H_
#define DPE_TESTS_SUPPORT_DERIVATIVE_CHECKER_H_

#include <Eigen/Core>

#include "dpe/engine/derivative_checker.h"

namespace dpe::test {

using dpe::CheckDirectionalDerivative;
using dpe::CheckJacobian;
using dpe::DerivativeCheck;
using dpe::VectorFunction;

// A vector of independent normal numbers from a seeded generator.
Eigen::VectorXd RandomVector(int size, unsigned seed);

}  // namespace dpe::test

#endif  // DPE_TESTS_SUPPORT_DERIVATIVE_CHECKER_H_
