#include "linear/dense_kernels.h"

namespace dpe {
namespace {

constexpr int kTilePacks = 3;
constexpr int kTileColumns = 4;

// Two doubles: what every 64-bit processor has; compilers turn the pairs into its
// instructions.
struct Pack {
  static constexpr int kWidth = 2;
  double low, high;

  static Pack Load(const double* p) { return {p[0], p[1]}; }
  static Pack Load(const double* p, int /*count: 1*/) { return {p[0], 0.0}; }
  static Pack All(double x) { return {x, x}; }
  void Store(double* p) const {
    p[0] = low;
    p[1] = high;
  }
  void Store(double* p, int /*count: 1*/) const { p[0] = low; }
  void Stream(double* p) const { Store(p); }
  static void EndStream() {}
};

inline Pack operator+(Pack a, Pack b) { return {a.low + b.low, a.high + b.high}; }
inline Pack operator*(Pack a, Pack b) { return {a.low * b.low, a.high * b.high}; }
inline Pack MultiplySubtract(Pack a, Pack b, Pack c) {
  return {c.low - a.low * b.low, c.high - a.high * b.high};
}

}  // namespace
}  // namespace dpe

#include "linear/dense_kernels_impl.h"

namespace dpe {
const DenseKernels* DenseKernelsGeneric() { return &kKernels; }
}  // namespace dpe
