// OBJ files: as meshes of the engine, as captures, and the cloths that are built from
// both.
#include "dpe/engine/cloth_builder.h"
#include "dpe/engine/scene_io.h"
#include "dpe/estimation/rest_shape.h"
#include "fuzz/fuzz_support.h"

namespace dpe::test {
namespace {

void CheckMesh(const TriangleMesh& mesh) {
  const int num_vertices = static_cast<int>(mesh.positions.size() / 3);
  Require(!mesh.triangles.empty(), "a mesh without triangles");
  Require(mesh.positions.allFinite(), "a vertex that is not finite");
  for (const std::array<int, 3>& triangle : mesh.triangles) {
    for (const int v : triangle) {
      Require(v >= 0 && v < num_vertices, "a triangle of no vertices");
    }
  }
}

// A cloth that the builder makes is one that a scene may have.
void CheckCloth(const ClothObject& cloth) {
  ValidateScene(MakeClothScene(ScenePreset::kSide, cloth), "built");
}

void FuzzMesh(const std::string& path) {
  IsAccepted([&] {
    const TriangleMesh mesh = LoadObjMesh(path);
    CheckMesh(mesh);
    CheckCloth(BuildClothFromMesh(mesh, {}));
  });
}

// The engine and captures read the same triangles, with corners at the same places.
void CompareTriangles(const TriangleMesh& mesh, const Capture& capture) {
  const std::vector<std::array<int, 3>>& others = capture.mesh.triangles;
  Require(mesh.triangles.size() == others.size(), "another number of triangles");
  for (std::size_t t = 0; t < others.size(); ++t) {
    for (int corner = 0; corner < 3; ++corner) {
      const int v = others[t][corner];
      Require(v >= 0 && v < capture.num_vertices, "a triangle of no vertices");
      Require(capture.samples[v].position ==
                  mesh.positions.segment<3>(3 * mesh.triangles[t][corner]),
              "a triangle of other vertices");
    }
  }
}

void FuzzRestShape(const std::string& path) {
  IsAccepted([&] {
    const Capture capture = ReadCapture(path);
    if (capture.format != "OBJ" || capture.mesh.triangles.empty()) return;
    CompareTriangles(LoadObjMesh(path), capture);
    for (const char* source : {"uv", "uv:2,3", path.c_str()}) {
      IsAccepted([&] {
        CheckCloth(
            BuildClothFromCapture(capture, ReadRestShape(source, 0.0, capture), {}));
      });
    }
  });
}

}  // namespace
}  // namespace dpe::test

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  static dpe::test::MemoryFile file;
  file.Write(dpe::test::TextOf(bytes, size));
  dpe::test::FuzzMesh(file.path());
  dpe::test::FuzzRestShape(file.path());
  return dpe::test::FuzzCapture("OBJ", bytes, size);
}
