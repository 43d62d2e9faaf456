// The dense arithmetic of sparse factorisations: products and triangular solves of
// small to middling column-major panels, compiled for several instruction sets and
// chosen once, at run time.
//
// BLAS is no better here: its calls cost more than the arithmetic of the narrow panels
// that a cloth's matrix falls into, and its threads would make results depend on them.
#ifndef DPE_ENGINE_LINEAR_DENSE_KERNELS_H_
#define DPE_ENGINE_LINEAR_DENSE_KERNELS_H_

namespace dpe {

// The widest panel that FactorizeDiagonal and SolveRight work on at once.
constexpr int kPanelWidth = 8;

struct DenseKernels {
  // C -= A B^T, or C := -A B^T if `overwrite` (c need not hold numbers then):
  //   c(i, j) -= sum_p a(i, p) b(j, p) with
  //   a(i, p) = a[i + p lda],  b(j, p) = b[j b_row + p b_column],  c(i, j) = c[i + j
  //   ldc].
  // @param m, n, k  i < m, j < n, p < k
  void (*subtract_product)(bool overwrite, int m, int n, int k, const double* a,
                           long lda, const double* b, long b_row, long b_column,
                           double* c, long ldc);

  // X := X T^{-1} for an upper triangular T of `width` <= kPanelWidth columns:
  //   x_j := (x_j - sum_{i < j} x_i t[i + kPanelWidth j]) scale[j],
  // x_j being column j of the m x width panel x.
  void (*solve_right)(int m, int width, const double* t, const double* scale, double* x,
                      long ldx);

  // Copies `count` doubles in whole lines of 64 bytes, from and to such addresses, past
  // the caches where the processor can: for what will not be read again soon.
  void (*stream)(long count, const double* from, double* to);
  // Before another thread may read such a copy.
  void (*end_stream)();
};

// Those for this processor.
const DenseKernels& BestDenseKernels();

// One per instruction set; null where this build or architecture has none. The last
// one is always there.
const DenseKernels* DenseKernelsAvx512();
const DenseKernels* DenseKernelsAvx2();
const DenseKernels* DenseKernelsGeneric();

}  // namespace dpe

#endif  // DPE_ENGINE_LINEAR_DENSE_KERNELS_H_
