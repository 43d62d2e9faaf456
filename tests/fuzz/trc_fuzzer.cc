// TRC files of motion capture systems.
#include "fuzz/fuzz_support.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  return dpe::test::FuzzCapture("TRC", bytes, size);
}
