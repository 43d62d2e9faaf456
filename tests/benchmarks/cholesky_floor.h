// The floor under a forward step: what CHOLMOD alone needs for the step's matrix.
#ifndef DPE_TESTS_BENCHMARKS_CHOLESKY_FLOOR_H_
#define DPE_TESTS_BENCHMARKS_CHOLESKY_FLOOR_H_

#include <cholmod.h>

#include "step_matrix.h"

namespace dpe::bench {

// Numeric factorisation and one solve of a symmetric positive definite matrix:
// supernodal, nested dissection, analysed beforehand, without CHOLMOD's own threads. It
// shares no code with the engine, so that it stays put when the engine changes.
class CholeskyFloor {
 public:
  explicit CholeskyFloor(const SymmetricMatrix& matrix);
  ~CholeskyFloor();
  CholeskyFloor(const CholeskyFloor&) = delete;
  CholeskyFloor& operator=(const CholeskyFloor&) = delete;

  // Mean over as many factorisations and solves as fit into `seconds`, at least two.
  // @return processor time of one, ms; NaN if the matrix is not positive definite
  double Milliseconds(double seconds);

  double num_factor_nonzeros() const { return common_.lnz; }

 private:
  bool FactorizeAndSolve();

  SymmetricMatrix matrix_;
  cholmod_common common_;
  cholmod_sparse sparse_;
  cholmod_factor* factor_ = nullptr;
  cholmod_dense* right_ = nullptr;
  cholmod_dense* solution_ = nullptr;  // kept so that a solve does not allocate
  cholmod_dense* work_y_ = nullptr;
  cholmod_dense* work_e_ = nullptr;
};

}  // namespace dpe::bench

#endif  // DPE_TESTS_BENCHMARKS_CHOLESKY_FLOOR_H_
