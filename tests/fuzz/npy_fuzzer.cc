// NumPy arrays.
#include "fuzz/fuzz_support.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  return dpe::test::FuzzCapture("NPY", bytes, size);
}
