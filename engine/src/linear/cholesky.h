// Sparse Cholesky of a symmetric positive definite matrix in a BlockPattern, by CHOLMOD
// (Chen, Davis, Hager & Rajamanickam 2008). The pattern is analysed once; copies share
// nothing and can be used from different threads.
#ifndef DPE_ENGINE_LINEAR_CHOLESKY_H_
#define DPE_ENGINE_LINEAR_CHOLESKY_H_

#include <cholmod.h>

#include "linear/block_pattern.h"

namespace dpe {

class Cholesky {
 public:
  explicit Cholesky(const BlockPattern& pattern);
  ~Cholesky();
  Cholesky(const Cholesky&) = delete;
  Cholesky& operator=(const Cholesky&) = delete;

  // Factorises the matrix whose lower triangle is in `values` (pattern order; the upper
  // triangle is not read). False if it is not positive definite.
  bool Factorize(const double* values);

  // Solves S x = b; b and x may be the same array. Factorize must have succeeded.
  void Solve(const double* b, double* x);

  // Solves for `count` right-hand sides, column-major, in place.
  void SolveMany(double* columns, int count);

 private:
  const BlockPattern& pattern_;
  cholmod_common common_;
  cholmod_sparse matrix_;
  cholmod_factor* factor_ = nullptr;
  cholmod_dense* solution_ = nullptr;  // kept so that a solve does not allocate
  cholmod_dense* work_y_ = nullptr;
  cholmod_dense* work_e_ = nullptr;
};

}  // namespace dpe

#endif  // DPE_ENGINE_LINEAR_CHOLESKY_H_
