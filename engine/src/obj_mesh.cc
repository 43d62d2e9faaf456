// The copy of tinyobjloader in this file reads double precision. Its own namespace is
// renamed so that it cannot meet a single precision copy elsewhere in the program.
#define tinyobj dpe_tinyobj
#define TINYOBJLOADER_USE_DOUBLE
#define TINYOBJLOADER_IMPLEMENTATION
#include <tiny_obj_loader.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <sstream>

#include "dpe/engine/cloth_builder.h"
#include "io/text_file.h"

namespace dpe {
namespace {

// The lines that say what a mesh is, the others empty, so that lines keep their
// numbers: what is not used (groups, materials, weights of skins, ...) cannot be wrong.
// Lines end with \n, whatever they end with in the file.
std::string MeshLines(const std::string& text) {
  std::string result;
  size_t begin = 0;
  while (begin < text.size()) {
    const size_t end = std::min(text.find_first_of("\r\n", begin), text.size());
    const std::string line = text.substr(begin, end - begin);
    const size_t word = std::min(line.find_first_not_of(" \t"), line.size());
    const size_t length = std::min(line.find_first_of(" \t", word), line.size()) - word;
    for (const char* used : {"v", "vn", "vt", "f"}) {
      if (line.compare(word, length, used) == 0) result += line;
    }
    result += '\n';
    begin = end + 1;
    if (end + 1 < text.size() && text[end] == '\r' && text[end + 1] == '\n') ++begin;
  }
  return result;
}

// The loader takes a coordinate that is not a number for zero, so the lines of the
// vertices are read here, with their line number.
std::vector<double> ReadVertices(const std::string& path, const std::string& text) {
  std::vector<double> coordinates;
  std::istringstream lines(text);
  std::string line;
  for (int number = 1; std::getline(lines, line); ++number) {
    const size_t start = line.find_first_not_of(" \t");
    if (start == std::string::npos || line[start] != 'v') continue;
    const char* cursor = line.c_str() + start + 1;
    if (*cursor != ' ' && *cursor != '\t') continue;  // vn, vt, ...
    for (int axis = 0; axis < 3; ++axis) {
      char* end = nullptr;
      const double value = std::strtod(cursor, &end);
      if (end == cursor || !std::isfinite(value)) {
        throw SceneError(path + ": line " + std::to_string(number) + ": \"" +
                         line.substr(0, 60) +
                         "\" is not accepted; expected \"v\" and three finite numbers");
      }
      coordinates.push_back(value);
      cursor = end;
    }
  }
  return coordinates;
}

// The loader ends each of its messages with a line break or two.
std::string OneLine(std::string message) {
  while (!message.empty() && message.back() == '\n') message.pop_back();
  std::replace(message.begin(), message.end(), '\n', ' ');
  return message;
}

std::vector<std::array<int, 3>> ReadTriangles(const std::string& path,
                                              const std::string& text) {
  tinyobj::ObjReaderConfig config;
  config.triangulate = true;
  config.vertex_color = false;
  tinyobj::ObjReader reader;
  if (!reader.ParseFromString(text, "", config)) {
    throw SceneError(path + ": " + OneLine(reader.Error()));
  }
  // Faces with a bad index or fewer than three corners are dropped with a warning; a
  // cloth with holes where nobody cut them is no use. Normals and textures are not
  // used.
  for (const char* problem : {"Vertex indices out of bounds", "egenerated face"}) {
    if (reader.Warning().find(problem) != std::string::npos) {
      throw SceneError(path + ": " + OneLine(reader.Warning()));
    }
  }
  std::vector<std::array<int, 3>> triangles;
  for (const tinyobj::shape_t& shape : reader.GetShapes()) {
    const auto& indices = shape.mesh.indices;
    for (size_t i = 0; i + 2 < indices.size(); i += 3) {
      triangles.push_back({indices[i].vertex_index, indices[i + 1].vertex_index,
                           indices[i + 2].vertex_index});
    }
  }
  return triangles;
}

// The triangles of a face are its corners less two. The loader makes fewer, without a
// warning, where it cannot cut a face up: one that touches itself, say.
void RequireWholeFaces(const std::string& path, const std::string& text, size_t made) {
  size_t expected = 0;
  std::istringstream lines(text);
  std::string line, word;
  while (std::getline(lines, line)) {
    std::istringstream words(line);
    if (!(words >> word) || word != "f") continue;
    size_t corners = 0;
    while (words >> word) ++corners;
    if (corners > 2) expected += corners - 2;
  }
  if (made == expected) return;
  throw SceneError(path + ": its faces are " + std::to_string(expected) +
                   " triangles, of which " + std::to_string(made) +
                   " could be cut out; expected faces whose corners are different and "
                   "go around them once");
}

}  // namespace

TriangleMesh LoadObjMesh(const std::string& path) {
  const std::string text = MeshLines(ReadTextFile(path, "an OBJ file"));
  const std::vector<double> coordinates = ReadVertices(path, text);
  TriangleMesh mesh;
  mesh.triangles = ReadTriangles(path, text);
  if (mesh.triangles.empty()) throw SceneError(path + ": it has no faces");
  RequireWholeFaces(path, text, mesh.triangles.size());

  const int num_vertices = static_cast<int>(coordinates.size() / 3);
  std::vector<int> new_index(num_vertices, -1);
  for (const std::array<int, 3>& triangle : mesh.triangles) {
    for (int v : triangle) {
      if (v < 0 || v >= num_vertices) {
        throw SceneError(path + ": a face names vertex " + std::to_string(v + 1) +
                         "; expected 1 to " + std::to_string(num_vertices));
      }
      new_index[v] = 0;
    }
  }
  std::vector<double> used;
  for (int v = 0; v < num_vertices; ++v) {
    if (new_index[v] < 0) continue;
    new_index[v] = static_cast<int>(used.size() / 3);
    used.insert(used.end(), &coordinates[3 * v], &coordinates[3 * v] + 3);
  }
  mesh.positions = Eigen::Map<const Eigen::VectorXd>(used.data(), used.size());
  for (std::array<int, 3>& triangle : mesh.triangles) {
    for (int& v : triangle) v = new_index[v];
  }
  return mesh;
}

}  // namespace dpe
