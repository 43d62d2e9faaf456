// Four single-precision numbers that are computed with at once, from and to addresses
// of any alignment.
//
// They are copied, not referred to through a pointer to a type of lesser alignment:
// where such a type is returned by reference Clang takes its alignment for the full one
// and makes instructions that fault. The copies are plain loads and stores.
#ifndef DPE_ENGINE_LINEAR_FLOAT4_H_
#define DPE_ENGINE_LINEAR_FLOAT4_H_

#include "linear/vectorize.h"

namespace dpe {

typedef float Float4 __attribute__((vector_size(16)));

DPE_ALWAYS_INLINE Float4 LoadFour(const float* in) {
  Float4 value;
  __builtin_memcpy(&value, in, sizeof(value));
  return value;
}

// out += value.
DPE_ALWAYS_INLINE void AddFour(Float4 value, float* out) {
  value += LoadFour(out);
  __builtin_memcpy(out, &value, sizeof(value));
}

}  // namespace dpe

#endif  // DPE_ENGINE_LINEAR_FLOAT4_H_
