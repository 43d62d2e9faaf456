// A factorisation that a rollout puts aside for its backward pass: a copy of the
// panels, made supernode by supernode while they are at hand.
//
// There are as many as there are steps, far more than the caches hold. Writing them
// there one after the other would fetch memory that is only overwritten, and push out
// what the next step needs; the copy goes past the caches (DenseKernels::stream), and
// the factorisation itself stays in memory that is warm. (A copy in single precision
// takes half the memory, but to iterate with it costs more than it saves: 15 % of a
// gradient at 48 x 48 vertices.)
#ifndef DPE_ENGINE_LINEAR_KEPT_FACTOR_H_
#define DPE_ENGINE_LINEAR_KEPT_FACTOR_H_

#include "linear/prefetch.h"
#include "linear/supernodal_panels.h"

namespace dpe {

struct KeptFactor {
  bool empty() const { return !has_factor; }
  void Clear() {
    has_factor = false;
    error = -1.0;
  }

  // Brings it into the caches.
  Prefetch Prefetched() const { return {panels.lower(), panels.size()}; }

  bool has_factor = false;
  // |b - A z| / |z| of the first solve with it, or what rounding leaves of that;
  // negative if that solve had to be iterated.
  double error = -1.0;
  SupernodalPanels panels;
};

}  // namespace dpe

#endif  // DPE_ENGINE_LINEAR_KEPT_FACTOR_H_
