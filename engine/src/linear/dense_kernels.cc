#include "linear/dense_kernels.h"

namespace dpe {
namespace {

const DenseKernels& Choose() {
#if defined(__x86_64__) && (defined(__GNUC__) || defined(__clang__))
  __builtin_cpu_init();
  if (DenseKernelsAvx512() != nullptr && __builtin_cpu_supports("avx512f") &&
      __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512dq")) {
    return *DenseKernelsAvx512();
  }
  if (DenseKernelsAvx2() != nullptr && __builtin_cpu_supports("avx2") &&
      __builtin_cpu_supports("fma")) {
    return *DenseKernelsAvx2();
  }
#endif
  return *DenseKernelsGeneric();
}

}  // namespace

const DenseKernels& BestDenseKernels() {
  static const DenseKernels& best = Choose();
  return best;
}

}  // namespace dpe
