#include "linear/dense_kernels.h"

#if defined(__AVX2__) && defined(__FMA__)

#include <immintrin.h>

namespace dpe {
namespace {

constexpr int kTilePacks = 3;
constexpr int kTileColumns = 4;

struct Pack {
  static constexpr int kWidth = 4;
  __m256d value;

  static Pack Load(const double* p) { return {_mm256_loadu_pd(p)}; }
  static Pack Load(const double* p, int count) {
    return {_mm256_maskload_pd(p, Mask(count))};
  }
  static Pack All(double x) { return {_mm256_set1_pd(x)}; }
  void Store(double* p) const { _mm256_storeu_pd(p, value); }
  void Store(double* p, int count) const { _mm256_maskstore_pd(p, Mask(count), value); }
  void Stream(double* p) const { _mm256_stream_pd(p, value); }
  static void EndStream() { _mm_sfence(); }
  static __m256i Mask(int count) {
    return _mm256_cmpgt_epi64(_mm256_set1_epi64x(count),
                              _mm256_setr_epi64x(0, 1, 2, 3));
  }
};

inline Pack operator+(Pack a, Pack b) { return {_mm256_add_pd(a.value, b.value)}; }
inline Pack operator*(Pack a, Pack b) { return {_mm256_mul_pd(a.value, b.value)}; }
inline Pack MultiplySubtract(Pack a, Pack b, Pack c) {
  return {_mm256_fnmadd_pd(a.value, b.value, c.value)};
}

}  // namespace
}  // namespace dpe

#include "linear/dense_kernels_impl.h"

namespace dpe {
const DenseKernels* DenseKernelsAvx2() { return &kKernels; }
}  // namespace dpe

#else

namespace dpe {
const DenseKernels* DenseKernelsAvx2() { return nullptr; }
}  // namespace dpe

#endif
