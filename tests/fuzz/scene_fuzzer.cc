// Scene files. What is accepted is valid, and is written so that it reads back to the
// same scene.
#include <vector>

#include "dpe/engine/scene_io.h"
#include "fuzz/fuzz_support.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  using namespace dpe::test;
  const std::string text = TextOf(bytes, size);
  IsAccepted([&] {
    std::vector<std::string> warnings;
    const dpe::Scene scene = dpe::ParseScene(text, "fuzz", &warnings);
    std::string written;
    Require(IsAccepted([&] {
              dpe::ValidateScene(scene, "read");
              written = dpe::SceneToJson(scene);
              const dpe::Scene again = dpe::ParseScene(written, "written");
              Require(dpe::SceneToJson(again) == written, "another scene was written");
            }),
            "a scene that was read cannot be written and read again");
  });
  return 0;
}
