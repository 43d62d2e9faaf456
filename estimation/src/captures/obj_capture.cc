#include <algorithm>
#include <limits>

#include "captures/obj_file.h"
#include "captures/readers.h"
#include "captures/text.h"
#include "dpe/engine/cloth_builder.h"

namespace dpe {
namespace {

std::string FaceText(const ObjFile& file, const ObjFace& face) {
  std::string text = "f";
  for (int i = face.begin; i < face.begin + face.size; ++i) {
    text += " " + std::to_string(file.vertices[i] + 1);
  }
  return text;
}

// Throws if the two files have not the same number of vertices and the same faces.
void RequireSameTopology(const ObjFile& first, const ObjFile& file) {
  if (file.num_vertices() != first.num_vertices()) {
    const int line = file.lines.empty() ? 1 : file.lines.back();
    FailAtLine(file.path, line,
               "is the last of " + std::to_string(file.num_vertices()) +
                   " vertices; accepted are " + std::to_string(first.num_vertices()) +
                   ", as in " + first.path);
  }
  const size_t common = std::min(first.faces.size(), file.faces.size());
  for (size_t f = 0; f < common; ++f) {
    const ObjFace &is = file.faces[f], &was = first.faces[f];
    const int* corners = file.vertices.data() + is.begin;
    if (is.size == was.size &&
        std::equal(corners, corners + is.size, first.vertices.data() + was.begin)) {
      continue;
    }
    FailAtLine(file.path, is.line,
               "is '" + FaceText(file, is) + "'; accepted is '" + FaceText(first, was) +
                   "', as in " + first.path + ":" + std::to_string(was.line));
  }
  if (file.faces.size() != first.faces.size()) {
    const int line = file.faces.empty() ? 1 : file.faces.back().line;
    FailAtLine(file.path, line,
               "is the last of " + std::to_string(file.faces.size()) +
                   " faces; accepted are " + std::to_string(first.faces.size()) +
                   ", as in " + first.path);
  }
}

void SetTexture(const ObjFile& file, CaptureMesh* mesh) {
  const bool has_texture = std::any_of(file.texture_of.begin(), file.texture_of.end(),
                                       [](int t) { return t >= 0; });
  if (!has_texture) return;
  mesh->texture_coordinates.setConstant(2, file.num_vertices(),
                                        std::numeric_limits<double>::quiet_NaN());
  for (const ObjFace& face : file.faces) {
    for (int i = face.begin; i < face.begin + face.size; ++i) {
      if (file.texture_of[i] < 0) continue;
      const Eigen::Vector2d uv(&file.textures[2 * file.texture_of[i]]);
      auto own = mesh->texture_coordinates.col(file.vertices[i]);
      if (!own.hasNaN() && own != uv && mesh->texture_seam.empty()) {
        mesh->texture_seam = file.path + ":" + std::to_string(face.line) + ": vertex " +
                             std::to_string(file.vertices[i]) +
                             " has two different texture coordinates (a seam)";
      }
      own = uv;
    }
  }
}

// The triangles that the engine makes of the faces, so that a cloth built from the same
// file has the same; vertices as counted in the file.
void SetTriangles(const ObjFile& file, CaptureMesh* mesh) {
  mesh->path = file.path;
  mesh->in_a_face.assign(file.num_vertices(), 0);
  for (int vertex : file.vertices) mesh->in_a_face[vertex] = 1;
  if (file.faces.empty()) return;
  std::vector<int> number_of;  // in the file, of each vertex that the engine keeps
  for (int v = 0; v < file.num_vertices(); ++v) {
    if (mesh->in_a_face[v]) number_of.push_back(v);
  }
  mesh->triangles = LoadObjMesh(file.path).triangles;
  for (std::array<int, 3>& triangle : mesh->triangles) {
    for (int& v : triangle) v = number_of.at(v);
  }
}

}  // namespace

Capture ReadObjSequence(const std::string& pattern,
                        const std::vector<SequenceFile>& files) {
  Capture capture;
  capture.path = pattern;
  capture.format = "OBJ";
  ObjFile first;
  for (const SequenceFile& entry : files) {
    ObjFile file = ParseObjFile(entry.path, ReadWholeFile(entry.path));
    if (capture.samples.empty()) {
      if (file.num_vertices() == 0) {
        throw SceneError(entry.path + ": has no vertices; accepted is an OBJ file");
      }
      capture.num_vertices = file.num_vertices();
      SetTriangles(file, &capture.mesh);
      SetTexture(file, &capture.mesh);
      first = file;
    } else {
      RequireSameTopology(first, file);
    }
    for (int v = 0; v < file.num_vertices(); ++v) {
      CaptureSample sample;
      sample.marker = v;
      sample.time = entry.number;
      sample.position = Eigen::Vector3d(&file.positions[3 * v]);
      capture.samples.push_back(sample);
    }
  }
  return capture;
}

}  // namespace dpe
