// Elements side by side: the numbers that a law needs of kBatch elements ("lanes"), one
// array per number, so that its loop over the lanes is vector code.
//
// A law's loops are functions under DPE_VECTORIZE over these arrays. They always run
// over all kBatch lanes; where elements run out, the last one is repeated.
#ifndef DPE_ENGINE_FORCES_ELEMENT_BATCH_H_
#define DPE_ENGINE_FORCES_ELEMENT_BATCH_H_

#include <type_traits>
#include <vector>

#include "forces/vec3.h"

namespace dpe {

// Elements per batch: whole vector registers, and what a term keeps on the stack (up
// to 16 KiB) stays in the first-level cache.
inline constexpr int kBatch = 32;

struct alignas(64) ScalarLanes {
  double at[kBatch];
};

struct alignas(64) VectorLanes {
  double x[kBatch], y[kBatch], z[kBatch];

  DPE_ALWAYS_INLINE Vec3 Get(int lane) const { return {x[lane], y[lane], z[lane]}; }
  DPE_ALWAYS_INLINE void Set(int lane, Vec3 value) {
    x[lane] = value.x;
    y[lane] = value.y;
    z[lane] = value.z;
  }
};

// 3x3 matrices by columns.
struct MatrixLanes {
  VectorLanes x, y, z;

  DPE_ALWAYS_INLINE void Set(int lane, const Mat3& value) {
    x.Set(lane, value.x);
    y.Set(lane, value.y);
    z.Set(lane, value.z);
  }
};

// Reduced coordinates as in element_term.h. Arrays that a pass does not need are not
// set: u and du where the law does not depend on velocities, dq and du without a
// direction, s outside adjoints.
template <int kCoords, int kConstants>
struct ElementBatch {
  ScalarLanes constants[kConstants > 0 ? kConstants : 1];  // the element's own
  VectorLanes q[kCoords];                                  // m
  VectorLanes u;                                           // m/s
  VectorLanes dq[kCoords];
  VectorLanes du;
  VectorLanes s;  // c times the sum over vertices of kForce lambda
};

// dphi/dq^T s and dphi/du^T s.
template <int kCoords>
struct AdjointLanes {
  VectorLanes q[kCoords];
  VectorLanes u;
};

// What a loop is to compute; a law has one loop for each combination.
struct LoopFlags {
  bool direction;  // dq and du are given; otherwise they count as zero
  bool velocity;   // u and du are given; otherwise nothing depends on them
};

// Repeats the last of the elements' values until they fill whole batches.
template <class T>
void PadToBatches(std::vector<T>* values) {
  if (values->empty()) return;
  const T last = values->back();
  values->resize((values->size() + kBatch - 1) / kBatch * kBatch, last);
}

// Calls loop(direction), or loop(direction, velocity), with the flags as types, so that
// each combination is compiled on its own.
template <class Loop>
DPE_ALWAYS_INLINE void WithDirection(LoopFlags flags, const Loop& loop) {
  if (flags.direction) {
    loop(std::true_type());
  } else {
    loop(std::false_type());
  }
}

template <class Loop>
DPE_ALWAYS_INLINE void WithFlags(LoopFlags flags, const Loop& loop) {
  WithDirection(flags, [&](auto direction) DPE_INLINE_LAMBDA {
    if (flags.velocity) {
      loop(direction, std::true_type());
    } else {
      loop(direction, std::false_type());
    }
  });
}

}  // namespace dpe

#endif  // DPE_ENGINE_FORCES_ELEMENT_BATCH_H_
