#include "support/blas_threads.h"

// Weak: null if the program was linked with another BLAS.
extern "C" void openblas_set_num_threads(int num_threads) __attribute__((weak));

namespace dpe::tools {

void SetBlasThreads(int num_threads) {
  if (openblas_set_num_threads != nullptr) openblas_set_num_threads(num_threads);
}

}  // namespace dpe::tools
