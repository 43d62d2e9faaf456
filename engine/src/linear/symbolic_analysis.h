// The symbolic analysis of a pattern by CHOLMOD (Chen, Davis, Hager & Rajamanickam
// 2008): which columns are factorised together, and what fills in. The pattern must be
// in a fill-reducing order already (ordering.h), so that nothing is permuted
// afterwards.
#ifndef DPE_ENGINE_LINEAR_SYMBOLIC_ANALYSIS_H_
#define DPE_ENGINE_LINEAR_SYMBOLIC_ANALYSIS_H_

#include <cholmod.h>

#include <cstddef>
#include <memory>
#include <vector>

#include "linear/block_pattern.h"
#include "linear/supernodal_solve.h"
#include "linear/supernodal_structure.h"

namespace dpe {

class SymbolicAnalysis {
 public:
  explicit SymbolicAnalysis(const BlockPattern& pattern);
  ~SymbolicAnalysis();
  SymbolicAnalysis(const SymbolicAnalysis&) = delete;
  SymbolicAnalysis& operator=(const SymbolicAnalysis&) = delete;

  // The structure that CHOLMOD found; SupernodalLu uses it too.
  const std::shared_ptr<const SupernodalStructure>& structure() const {
    return structure_;
  }

 private:
  cholmod_common common_;
  cholmod_sparse matrix_;  // the pattern; values are set per factorisation
  cholmod_factor* symbolic_ = nullptr;
  std::shared_ptr<const SupernodalStructure> structure_;
};

}  // namespace dpe

#endif  // DPE_ENGINE_LINEAR_SYMBOLIC_ANALYSIS_H_
