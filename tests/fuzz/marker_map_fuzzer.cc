// Files that say which marker is which vertex.
#include <set>

#include "dpe/estimation/attach.h"
#include "fuzz/fuzz_support.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  using namespace dpe::test;
  static MemoryFile file;
  file.Write(TextOf(bytes, size));
  IsAccepted([] {
    const auto map = dpe::ReadMarkerMap(file.path());
    Require(!map.empty(), "an empty map");
    std::set<int> vertices;
    for (const auto& [name, vertex] : map) {
      Require(vertex >= 0, "a vertex before the first");
      Require(vertices.insert(vertex).second, "a vertex with two markers");
    }
  });
  return 0;
}
