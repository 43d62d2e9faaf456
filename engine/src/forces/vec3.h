// Vectors and matrices of three as plain numbers, for laws that are evaluated on many
// elements at once: in a loop over elements a compiler turns each component into a
// vector register. (Eigen's types hide the components behind loops and SSE intrinsics,
// which stops it.)
#ifndef DPE_ENGINE_FORCES_VEC3_H_
#define DPE_ENGINE_FORCES_VEC3_H_

#include "linear/vectorize.h"

namespace dpe {

struct Vec3 {
  double x, y, z;
};

DPE_ALWAYS_INLINE Vec3 operator+(Vec3 a, Vec3 b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
DPE_ALWAYS_INLINE Vec3 operator-(Vec3 a, Vec3 b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
DPE_ALWAYS_INLINE Vec3 operator*(double s, Vec3 a) {
  return {s * a.x, s * a.y, s * a.z};
}
DPE_ALWAYS_INLINE double Dot(Vec3 a, Vec3 b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
DPE_ALWAYS_INLINE Vec3 Cross(Vec3 a, Vec3 b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

// A 3x3 matrix by columns.
struct Mat3 {
  Vec3 x, y, z;
};

DPE_ALWAYS_INLINE Mat3 operator+(const Mat3& a, const Mat3& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
// a b^T.
DPE_ALWAYS_INLINE Mat3 Outer(Vec3 a, Vec3 b) { return {b.x * a, b.y * a, b.z * a}; }
// m + the matrix of (a x .).
DPE_ALWAYS_INLINE Mat3 AddCross(const Mat3& m, Vec3 a) {
  return {{m.x.x, m.x.y + a.z, m.x.z - a.y},
          {m.y.x - a.z, m.y.y, m.y.z + a.x},
          {m.z.x + a.y, m.z.y - a.x, m.z.z}};
}
// m + a I.
DPE_ALWAYS_INLINE Mat3 AddDiagonal(const Mat3& m, double a) {
  return {
      {m.x.x + a, m.x.y, m.x.z}, {m.y.x, m.y.y + a, m.y.z}, {m.z.x, m.z.y, m.z.z + a}};
}

}  // namespace dpe

#endif  // DPE_ENGINE_FORCES_VEC3_H_
