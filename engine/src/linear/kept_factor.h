// A factorisation put aside for later, in single precision: half the memory, and half
// the time to write and read it, which for small cloths is as much as factorising
// again. As a preconditioner of the matrix that it belongs to it gains six to seven
// digits per iteration, so two or three lead to rounding level.
#ifndef DPE_ENGINE_LINEAR_KEPT_FACTOR_H_
#define DPE_ENGINE_LINEAR_KEPT_FACTOR_H_

#include <cstddef>
#include <memory>
#include <vector>

#include "linear/supernodal_solve.h"
#include "linear/supernodal_structure.h"

namespace dpe {

class KeptFactor {
 public:
  bool empty() const { return lower_.empty(); }
  void Clear();

  // Copies `factor`, whose arrays `structure` owns.
  void Store(const std::shared_ptr<const SupernodalStructure>& structure,
             const SupernodalFactor& factor);

  // Valid until the next Store or Clear.
  SingleFactor factor() const;

 private:
  std::shared_ptr<const SupernodalStructure> structure_;
  std::vector<float> lower_, upper_;  // upper_ is empty for L L^T
};

}  // namespace dpe

#endif  // DPE_ENGINE_LINEAR_KEPT_FACTOR_H_
