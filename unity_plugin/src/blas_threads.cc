#include "blas_threads.h"

#include <mutex>

// Weak: null if the program was linked with another BLAS.
extern "C" void openblas_set_num_threads(int num_threads) __attribute__((weak));

namespace dpe::c {

void UseOneBlasThread() {
  static std::once_flag once;
  std::call_once(once, [] {
    if (openblas_set_num_threads != nullptr) openblas_set_num_threads(1);
  });
}

}  // namespace dpe::c
