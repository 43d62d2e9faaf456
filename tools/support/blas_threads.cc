#include "support/blas_threads.h"

// Weak: null if the program was linked with another BLAS.
extern "C" void openblas_set_num_threads(int num_threads) __attribute__((weak));

namespace dpe::tools {

void UseOneBlasThread() {
  if (openblas_set_num_threads != nullptr) openblas_set_num_threads(1);
}

}  // namespace dpe::tools
