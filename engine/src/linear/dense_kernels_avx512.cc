#include "linear/dense_kernels.h"

#ifdef __AVX512F__

#include <immintrin.h>

namespace dpe {
namespace {

constexpr int kTilePacks = 3;
constexpr int kTileColumns = 8;

struct Pack {
  static constexpr int kWidth = 8;
  __m512d value;

  static Pack Load(const double* p) { return {_mm512_loadu_pd(p)}; }
  static Pack Load(const double* p, int count) {
    return {_mm512_maskz_loadu_pd(Mask(count), p)};
  }
  static Pack All(double x) { return {_mm512_set1_pd(x)}; }
  void Store(double* p) const { _mm512_storeu_pd(p, value); }
  void Store(double* p, int count) const {
    _mm512_mask_storeu_pd(p, Mask(count), value);
  }
  void Stream(double* p) const { _mm512_stream_pd(p, value); }
  static void EndStream() { _mm_sfence(); }
  static __mmask8 Mask(int count) { return static_cast<__mmask8>((1u << count) - 1u); }
};

inline Pack operator+(Pack a, Pack b) { return {_mm512_add_pd(a.value, b.value)}; }
inline Pack operator*(Pack a, Pack b) { return {_mm512_mul_pd(a.value, b.value)}; }
inline Pack MultiplySubtract(Pack a, Pack b, Pack c) {
  return {_mm512_fnmadd_pd(a.value, b.value, c.value)};
}

}  // namespace
}  // namespace dpe

#include "linear/dense_kernels_impl.h"

namespace dpe {
const DenseKernels* DenseKernelsAvx512() { return &kKernels; }
}  // namespace dpe

#else

namespace dpe {
const DenseKernels* DenseKernelsAvx512() { return nullptr; }
}  // namespace dpe

#endif
