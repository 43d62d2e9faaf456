// Captures and trajectories in CSV files.
#include "dpe/estimation/trajectory_io.h"
#include "fuzz/fuzz_support.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  using namespace dpe::test;
  static MemoryFile file;
  file.Write(TextOf(bytes, size));
  IsAccepted([] { dpe::ReadTrajectoryCsv(file.path(), FuzzScene(), 0); });
  return FuzzCapture("CSV", bytes, size);
}
