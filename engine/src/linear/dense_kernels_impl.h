// The kernels of dense_kernels.h, written once over a pack of doubles. Each file
// dense_kernels_<instruction set>.cc defines `Pack` for its instructions, includes this
// file, and is compiled with the flags that allow them.
//
// Everything here is in an unnamed namespace and uses no library function: what such a
// file compiles must never be linked into code that runs on other processors.
//
// A Pack has  kWidth;  Pack::Load(p), Load(p, count), Store(p), Store(p, count) (the
// first `count` doubles, in 1..kWidth);  Stream(p), to an address that is a multiple of
// its size, and EndStream() after the last;  Pack::All(x);  MultiplySubtract(a, b, c) =
// c - a b; a * b.
#ifndef DPE_ENGINE_LINEAR_DENSE_KERNELS_IMPL_H_
#define DPE_ENGINE_LINEAR_DENSE_KERNELS_IMPL_H_

#include "linear/dense_kernels.h"

namespace dpe {
namespace {

// A tile's rows of a are to stay in the first-level cache: so many terms of the sum are
// added in one pass.
constexpr int kPassTerms = 128;

// A tile of kPacks packs of rows by kColumns columns stays in registers over the whole
// sum; `last` rows of its last pack count.
template <bool kOverwrite, int kPacks, int kColumns>
inline void SubtractTile(int k, const double* a, long lda, const double* b, long b_row,
                         long b_column, double* c, long ldc, int last) {
  constexpr int kWidth = Pack::kWidth;
  const bool whole = last == kWidth;
  Pack sum[kColumns][kPacks];
  for (int j = 0; j < kColumns; ++j) {
    for (int v = 0; v < kPacks; ++v) sum[j][v] = Pack::All(0.0);
  }
  for (int p = 0; p < k; ++p) {
    Pack in[kPacks];
    for (int v = 0; v + 1 < kPacks; ++v) in[v] = Pack::Load(a + v * kWidth);
    const double* end = a + (kPacks - 1) * kWidth;
    in[kPacks - 1] = whole ? Pack::Load(end) : Pack::Load(end, last);
    for (int j = 0; j < kColumns; ++j) {
      const Pack factor = Pack::All(b[j * b_row]);
      for (int v = 0; v < kPacks; ++v) {
        sum[j][v] = MultiplySubtract(in[v], factor, sum[j][v]);
      }
    }
    a += lda;
    b += b_column;
  }
  for (int j = 0; j < kColumns; ++j, c += ldc) {
    for (int v = 0; v < kPacks; ++v) {
      double* out = c + v * kWidth;
      const Pack value = sum[j][v];
      if (v + 1 < kPacks || whole) {
        (kOverwrite ? value : Pack::Load(out) + value).Store(out);
      } else {
        (kOverwrite ? value : Pack::Load(out, last) + value).Store(out, last);
      }
    }
  }
}

// All columns for the rows of one tile; a's part of it stays in the first-level cache.
template <bool kOverwrite, int kPacks>
inline void SubtractRows(int n, int k, const double* a, long lda, const double* b,
                         long b_row, long b_column, double* c, long ldc, int last) {
  int j = 0;
  for (; j + kTileColumns <= n; j += kTileColumns) {
    SubtractTile<kOverwrite, kPacks, kTileColumns>(k, a, lda, b + j * b_row, b_row,
                                                   b_column, c + j * ldc, ldc, last);
  }
  for (; j + 6 <= n; j += 6) {
    SubtractTile<kOverwrite, kPacks, 6>(k, a, lda, b + j * b_row, b_row, b_column,
                                        c + j * ldc, ldc, last);
  }
  // Unknowns come in threes, and so do most of the remaining columns.
  for (; j + 3 <= n; j += 3) {
    SubtractTile<kOverwrite, kPacks, 3>(k, a, lda, b + j * b_row, b_row, b_column,
                                        c + j * ldc, ldc, last);
  }
  for (; j < n; ++j) {
    SubtractTile<kOverwrite, kPacks, 1>(k, a, lda, b + j * b_row, b_row, b_column,
                                        c + j * ldc, ldc, last);
  }
}

// The terms p of one pass.
template <bool kOverwrite>
void SubtractTerms(int m, int n, int k, const double* a, long lda, const double* b,
                   long b_row, long b_column, double* c, long ldc) {
  constexpr int kWidth = Pack::kWidth;
  constexpr int kTileRows = kTilePacks * kWidth;
  int i = 0;
  for (; i + kTileRows <= m; i += kTileRows) {
    SubtractRows<kOverwrite, kTilePacks>(n, k, a + i, lda, b, b_row, b_column, c + i,
                                         ldc, kWidth);
  }
  const int rest = m - i;
  if (rest == 0) return;
  const int packs = (rest + kWidth - 1) / kWidth;
  const int last = rest - (packs - 1) * kWidth;
  if (packs == 1) {
    SubtractRows<kOverwrite, 1>(n, k, a + i, lda, b, b_row, b_column, c + i, ldc, last);
  } else if (packs == 2) {
    SubtractRows<kOverwrite, 2>(n, k, a + i, lda, b, b_row, b_column, c + i, ldc, last);
  } else {
    SubtractRows<kOverwrite, 3>(n, k, a + i, lda, b, b_row, b_column, c + i, ldc, last);
  }
}

void SubtractProduct(bool overwrite, int m, int n, int k, const double* a, long lda,
                     const double* b, long b_row, long b_column, double* c, long ldc) {
  int p = 0;
  if (overwrite) {
    p = k < kPassTerms ? k : kPassTerms;
    SubtractTerms<true>(m, n, p, a, lda, b, b_row, b_column, c, ldc);
  }
  for (; p < k; p += kPassTerms) {
    SubtractTerms<false>(m, n, k - p < kPassTerms ? k - p : kPassTerms, a + p * lda,
                         lda, b + p * b_column, b_row, b_column, c, ldc);
  }
}

inline void SolveRightRows(int width, const double* t, const double* scale, double* x,
                           long ldx, int count) {
  Pack solved[kPanelWidth];
  for (int j = 0; j < width; ++j) {
    double* column = x + j * ldx;
    Pack value = count == Pack::kWidth ? Pack::Load(column) : Pack::Load(column, count);
    for (int i = 0; i < j; ++i) {
      value = MultiplySubtract(solved[i], Pack::All(t[i + kPanelWidth * j]), value);
    }
    solved[j] = value * Pack::All(scale[j]);
    if (count == Pack::kWidth) {
      solved[j].Store(column);
    } else {
      solved[j].Store(column, count);
    }
  }
}

void SolveRight(int m, int width, const double* t, const double* scale, double* x,
                long ldx) {
  int i = 0;
  for (; i + Pack::kWidth <= m; i += Pack::kWidth) {
    SolveRightRows(width, t, scale, x + i, ldx, Pack::kWidth);
  }
  if (i < m) SolveRightRows(width, t, scale, x + i, ldx, m - i);
}

void Stream(long count, const double* from, double* to) {
  for (long i = 0; i < count; i += Pack::kWidth) Pack::Load(from + i).Stream(to + i);
}

const DenseKernels kKernels = {SubtractProduct, SolveRight, Stream, Pack::EndStream};

}  // namespace
}  // namespace dpe

#endif  // DPE_ENGINE_LINEAR_DENSE_KERNELS_IMPL_H_
