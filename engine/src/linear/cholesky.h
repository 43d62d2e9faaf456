// Sparse Cholesky of a symmetric positive definite matrix in a BlockPattern, by CHOLMOD
// (Chen, Davis, Hager & Rajamanickam 2008). The pattern must be in a fill-reducing
// order already (ordering.h): CHOLMOD then factorises it in place, without permuting.
#ifndef DPE_ENGINE_LINEAR_CHOLESKY_H_
#define DPE_ENGINE_LINEAR_CHOLESKY_H_

#include <cholmod.h>

#include <cstddef>
#include <memory>
#include <vector>

#include "linear/block_pattern.h"
#include "linear/supernodal_solve.h"
#include "linear/supernodal_structure.h"

namespace dpe {

// The symbolic analysis of a pattern and CHOLMOD's workspace, shared by all
// factorisations of one object; they must not be used from several threads at once.
class CholeskyAnalysis {
 public:
  explicit CholeskyAnalysis(const BlockPattern& pattern);
  ~CholeskyAnalysis();
  CholeskyAnalysis(const CholeskyAnalysis&) = delete;
  CholeskyAnalysis& operator=(const CholeskyAnalysis&) = delete;

  // The structure that CHOLMOD found; SupernodalLu uses it too.
  const std::shared_ptr<const SupernodalStructure>& structure() const {
    return structure_;
  }

 private:
  friend class Cholesky;
  cholmod_common common_;
  cholmod_sparse matrix_;  // the pattern; values are set per factorisation
  cholmod_factor* symbolic_ = nullptr;
  std::shared_ptr<const SupernodalStructure> structure_;
};

class Cholesky {
 public:
  explicit Cholesky(std::shared_ptr<CholeskyAnalysis> analysis);
  ~Cholesky();
  Cholesky(const Cholesky&) = delete;
  Cholesky& operator=(const Cholesky&) = delete;

  // Factorises the matrix whose lower triangle is in `values` (pattern order; the upper
  // triangle is not read). False if it is not positive definite.
  bool Factorize(const double* values);

  // For SolveSupernodal; Factorize must have succeeded.
  SupernodalFactor factor() const;

 private:
  std::shared_ptr<CholeskyAnalysis> analysis_;
  cholmod_factor* factor_ = nullptr;
};

}  // namespace dpe

#endif  // DPE_ENGINE_LINEAR_CHOLESKY_H_
