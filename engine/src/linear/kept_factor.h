// A factorisation that a rollout puts aside for its backward pass.
//
// It is handed over, not copied: the next factorisation goes into the memory that was
// there before. (A copy in single precision takes half the memory, but to make it and
// to iterate with it costs more than it saves: 15 % of a gradient at 48 x 48 vertices.)
#ifndef DPE_ENGINE_LINEAR_KEPT_FACTOR_H_
#define DPE_ENGINE_LINEAR_KEPT_FACTOR_H_

#include <memory>

#include "linear/supernodal_lu.h"

namespace dpe {

struct KeptFactor {
  bool empty() const { return !has_factor; }
  void Clear() { has_factor = false; }

  bool has_factor = false;
  // |b - A z| / |z| of the solve that it served first, or what rounding leaves of that;
  // negative if that solve had to be iterated.
  double error = -1.0;
  std::unique_ptr<SupernodalLu> lu;
};

}  // namespace dpe

#endif  // DPE_ENGINE_LINEAR_KEPT_FACTOR_H_
