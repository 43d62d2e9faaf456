// One OBJ file of a sequence: vertices, texture coordinates and faces, with lines.
//
// tinyobjloader, which the engine uses to triangulate meshes (LoadObjMesh), takes a
// coordinate that is not a number for zero and does not say in which line a face
// stands, so it can neither refuse a bad file as we promise nor say where two files
// differ.
#ifndef DPE_ESTIMATION_SRC_CAPTURES_OBJ_FILE_H_
#define DPE_ESTIMATION_SRC_CAPTURES_OBJ_FILE_H_

#include <string>
#include <vector>

namespace dpe {

struct ObjFace {
  int line = 0;
  int begin = 0;  // of its corners
  int size = 0;
};

struct ObjFile {
  std::string path;
  std::vector<double> positions;  // x, y, z of each vertex
  std::vector<int> lines;         // of each vertex
  std::vector<double> textures;   // u, v
  std::vector<ObjFace> faces;
  std::vector<int> vertices;    // of all corners, from 0
  std::vector<int> texture_of;  // of all corners, from 0; -1: none

  int num_vertices() const { return static_cast<int>(lines.size()); }
};

// Lines other than v, vt and f are skipped.
// @throws SceneError naming file, line, value and what is accepted
ObjFile ParseObjFile(const std::string& path, const std::string& content);

}  // namespace dpe

#endif  // DPE_ESTIMATION_SRC_CAPTURES_OBJ_FILE_H_
