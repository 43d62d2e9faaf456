#include "dpe/estimation/rest_shape.h"

#include <algorithm>
#include <cmath>

#include "captures/text.h"

namespace dpe {
namespace {

constexpr char kUv[] = "uv";

bool IsTexture(const std::string& source) {
  return source == kUv || source.rfind("uv:", 0) == 0;
}

// m per unit of u and v.
Eigen::Vector2d TextureSize(const std::string& source) {
  if (source == kUv) return {1.0, 1.0};
  std::vector<std::string_view> fields;
  SplitFields(std::string_view(source).substr(3), ',', &fields);
  Eigen::Vector2d size(0.0, 0.0);
  bool ok = fields.size() <= 2;
  for (size_t i = 0; ok && i < fields.size(); ++i) {
    ok = ParseNumber(fields[i], &size[i]) && std::isfinite(size[i]) && size[i] > 0.0;
  }
  if (!ok) {
    throw SceneError("rest shape: \"" + source +
                     "\" is not accepted; expected uv, uv:SIZE or uv:U,V with numbers "
                     "> 0 (m per unit of the texture), or an OBJ file");
  }
  if (fields.size() == 1) size[1] = size[0];
  return size;
}

Eigen::VectorXd TextureShape(const CaptureMesh& mesh, const std::string& name,
                             const Eigen::Vector2d& size) {
  if (mesh.texture_coordinates.size() == 0) {
    throw SceneError(name +
                     ": has no texture coordinates to take the rest shape from; "
                     "accepted are OBJ files whose faces have them (f 1/1 2/2 3/3)");
  }
  if (!mesh.texture_seam.empty()) {
    throw SceneError(
        mesh.texture_seam +
        "; accepted as rest shape is one per vertex, or an OBJ file of the "
        "cloth at rest");
  }
  std::vector<double> rest;
  for (int v = 0; v < mesh.texture_coordinates.cols(); ++v) {
    if (!mesh.in_a_face[v]) continue;
    const Eigen::Vector2d uv = mesh.texture_coordinates.col(v);
    if (uv.hasNaN()) {
      throw SceneError(mesh.path + ": vertex " + std::to_string(v) +
                       " has no texture coordinate; accepted as rest shape is one for "
                       "every vertex of a face");
    }
    rest.insert(rest.end(), {size[0] * uv[0], 0.0, -size[1] * uv[1]});
  }
  return Eigen::Map<const Eigen::VectorXd>(rest.data(),
                                           static_cast<Eigen::Index>(rest.size()));
}

int ObjectOfSize(int num_vertices, const std::string& source, int object,
                 const Scene& scene) {
  std::string sizes;
  int found = -1, count = 0;
  for (int o = 0; o < static_cast<int>(scene.objects.size()); ++o) {
    const int size = scene.objects[o].num_vertices();
    sizes += (o > 0 ? ", " : "") + std::to_string(size);
    if (size != num_vertices || (object >= 0 && o != object)) continue;
    found = o;
    ++count;
  }
  if (count == 1) return found;
  throw SceneError(source + ": has " + std::to_string(num_vertices) +
                   " vertices; accepted is the number of vertices of " +
                   (object >= 0 ? "object " + std::to_string(object)
                                : "one object, or of several if one is named") +
                   " (the objects have " + sizes + ")");
}

}  // namespace

Eigen::VectorXd ReadRestShape(const std::string& source, double scale,
                              const Capture& capture) {
  if (IsTexture(source)) {
    return TextureShape(capture.mesh, capture.path, TextureSize(source));
  }
  return (scale > 0.0 ? scale : 1.0) * LoadObjMesh(source).positions;
}

void SetRestShape(const Eigen::VectorXd& rest, const std::string& source, int object,
                  Scene* scene, std::vector<std::string>* warnings) {
  const int o = ObjectOfSize(static_cast<int>(rest.size() / 3), source, object, *scene);
  ClothObject& cloth = scene->objects[o];
  Eigen::VectorXd lengths(cloth.num_springs());
  int num_far = 0;
  for (int s = 0; s < cloth.num_springs(); ++s) {
    const auto [a, b] = cloth.springs[s];
    lengths[s] = (rest.segment<3>(3 * a) - rest.segment<3>(3 * b)).norm();
    if (!(lengths[s] > 0.0)) {
      throw SceneError(source + ": vertices " + std::to_string(a) + " and " +
                       std::to_string(b) + " coincide, and spring " +
                       std::to_string(s) + " is between them");
    }
    const double now =
        (cloth.positions.segment<3>(3 * a) - cloth.positions.segment<3>(3 * b)).norm();
    if (now > 2.0 * lengths[s] || now < 0.5 * lengths[s]) ++num_far;
  }
  cloth.rest_length = lengths;
  if (num_far > 0 && warnings != nullptr) {
    warnings->push_back(source + ": " + std::to_string(num_far) + " of " +
                        std::to_string(cloth.num_springs()) + " springs of object " +
                        std::to_string(o) +
                        " start at less than half or more than twice their rest "
                        "length; is the size right, and the order of the vertices?");
  }
}

ClothObject BuildClothFromCapture(const Capture& capture, const Eigen::VectorXd& rest,
                                  const ClothMaterial& material) {
  const CaptureMesh& source = capture.mesh;
  if (source.triangles.empty()) {
    throw SceneError(
        capture.path +
        ": has no triangles to build a cloth from; accepted are OBJ files");
  }
  std::vector<int> index(source.in_a_face.size(), -1);
  std::vector<double> first;
  for (size_t v = 0; v < index.size(); ++v) {
    if (!source.in_a_face[v]) continue;
    index[v] = static_cast<int>(first.size() / 3);
    // The samples of an OBJ sequence are in the order of the vertices.
    const Eigen::Vector3d& p = capture.samples[v].position;
    first.insert(first.end(), p.data(), p.data() + 3);
  }
  TriangleMesh mesh;
  mesh.positions = Eigen::Map<const Eigen::VectorXd>(
      first.data(), static_cast<Eigen::Index>(first.size()));
  const Eigen::VectorXd positions = mesh.positions;
  for (const auto& [a, b, c] : source.triangles) {
    mesh.triangles.push_back({index[a], index[b], index[c]});
  }
  if (rest.size() == 0) return BuildClothFromMesh(mesh, material);
  if (rest.size() != positions.size()) {
    throw SceneError(capture.path + ": the mesh has " +
                     std::to_string(positions.size() / 3) +
                     " vertices and the rest shape " + std::to_string(rest.size() / 3) +
                     "; accepted is the same number");
  }
  mesh.positions = rest;
  ClothObject cloth = BuildClothFromMesh(mesh, material);
  cloth.rest_length = RestLengths(cloth);
  cloth.positions = positions;
  return cloth;
}

}  // namespace dpe
