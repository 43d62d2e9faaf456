// Point caches (PC2).
#include "fuzz/fuzz_support.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  return dpe::test::FuzzCapture("PC2", bytes, size);
}
