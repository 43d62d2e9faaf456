// Checkpoints of fits. What is accepted is written so that it reads back to the same.
#include "dpe/estimation/checkpoint.h"
#include "fuzz/fuzz_support.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  using namespace dpe::test;
  const std::string text = TextOf(bytes, size);
  IsAccepted([&] {
    const dpe::Checkpoint checkpoint = dpe::ParseCheckpoint(text, "fuzz");
    Require(checkpoint.num_frames >= 0 && checkpoint.iterations >= 0,
            "a negative count");
    Require(checkpoint.start.size() == checkpoint.coordinates.size(),
            "points of different size");
    Require(IsAccepted([&] {
              const std::string written = dpe::CheckpointToJson(checkpoint);
              const dpe::Checkpoint again = dpe::ParseCheckpoint(written, "written");
              Require(dpe::CheckpointToJson(again) == written,
                      "another checkpoint was written");
            }),
            "a checkpoint that was read cannot be written and read again");
  });
  return 0;
}
