// Keeps the linear algebra library from starting threads of its own.
#ifndef DPE_TOOLS_SUPPORT_BLAS_THREADS_H_
#define DPE_TOOLS_SUPPORT_BLAS_THREADS_H_

namespace dpe::tools {

// Limits OpenBLAS to one thread. Left alone it takes every processor, which for
// matrices of our size costs more than it gains; and where our own threads (--threads)
// call it at the same time, they wait for one another's. Does nothing with another
// BLAS.
void UseOneBlasThread();

}  // namespace dpe::tools

#endif  // DPE_TOOLS_SUPPORT_BLAS_THREADS_H_
