#ifndef DPE_UNITY_BLAS_THREADS_H_
#define DPE_UNITY_BLAS_THREADS_H_

namespace dpe::c {

// Sums in a fixed order, whatever the number of processors: with this the library
// computes the same numbers as the command line programs. Does nothing if the library
// was linked with a BLAS other than OpenBLAS.
void UseOneBlasThread();

}  // namespace dpe::c

#endif  // DPE_UNITY_BLAS_THREADS_H_
