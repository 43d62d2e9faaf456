// The few LAPACK and BLAS routines that are called directly. They are declared here
// because LAPACK has no header of its own that every distribution installs.
#ifndef DPE_ENGINE_LINEAR_LAPACK_H_
#define DPE_ENGINE_LINEAR_LAPACK_H_

extern "C" {

// LU factorisation with partial pivoting, column-major.
void dgetrf_(const int* m, const int* n, double* a, const int* lda, int* pivots,
             int* info);

// B := alpha op(A)^{-1} B or alpha B op(A)^{-1}, A triangular.
void dtrsm_(const char* side, const char* triangle, const char* op, const char* unit,
            const int* m, const int* n, const double* alpha, const double* a,
            const int* lda, double* b, const int* ldb);

}  // extern "C"

#endif  // DPE_ENGINE_LINEAR_LAPACK_H_
