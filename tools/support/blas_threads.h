// Keeps the linear algebra library to the number of threads that the user asked for.
#ifndef DPE_TOOLS_SUPPORT_BLAS_THREADS_H_
#define DPE_TOOLS_SUPPORT_BLAS_THREADS_H_

namespace dpe::tools {

// Limits OpenBLAS to `num_threads` threads. Left alone it takes every processor, which
// for matrices of our size costs more than it gains. Does nothing with another BLAS.
void SetBlasThreads(int num_threads);

}  // namespace dpe::tools

#endif  // DPE_TOOLS_SUPPORT_BLAS_THREADS_H_
