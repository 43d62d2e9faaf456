// Sparse Cholesky of a symmetric positive definite matrix in a BlockPattern, by CHOLMOD
// (Chen, Davis, Hager & Rajamanickam 2008). The pattern is analysed once. It
// must be in a fill-reducing order already (ordering.h): CHOLMOD then factorises it in
// place, without permuting.
#ifndef DPE_ENGINE_LINEAR_CHOLESKY_H_
#define DPE_ENGINE_LINEAR_CHOLESKY_H_

#include <cholmod.h>

#include <vector>

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

 private:
  const BlockPattern& pattern_;
  cholmod_common common_;
  cholmod_sparse matrix_;
  cholmod_factor* factor_ = nullptr;
  std::vector<double> work_;
};

}  // namespace dpe

#endif  // DPE_ENGINE_LINEAR_CHOLESKY_H_
