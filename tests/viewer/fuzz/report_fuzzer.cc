// Reports, of which dpe_viewer reads standard deviations.
#include "dpe/engine/scene.h"
#include "fuzz/fuzz_support.h"
#include "scene_view/deviations_io.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  using namespace dpe::test;
  static MemoryFile file;
  file.Write(TextOf(bytes, size));
  IsAccepted([] {
    const auto deviations = dpe::viewer::ReadDeviations(file.path(), FuzzScene());
    for (std::size_t k = 0; k < FuzzScene().objects.size(); ++k) {
      const dpe::ClothObject& object = FuzzScene().objects[k];
      Require(deviations.stiffness[k].size() == 0 ||
                  deviations.stiffness[k].size() == object.num_springs(),
              "deviations of other springs");
      Require(deviations.mass[k].size() == 0 ||
                  deviations.mass[k].size() == object.num_vertices(),
              "deviations of other vertices");
    }
  });
  return 0;
}
