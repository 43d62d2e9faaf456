// One cloth as surfaces, lines and points.
#ifndef DPE_VIEWER_SCENE_VIEW_CLOTH_PICTURE_H_
#define DPE_VIEWER_SCENE_VIEW_CLOTH_PICTURE_H_

#include <Eigen/Core>
#include <array>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <memory>
#include <utility>
#include <vector>

#include "dpe/engine/scene.h"
#include "picture/picture.h"

namespace dpe::viewer {

// Unit normals at vertices: those of the triangles, weighted by area. (0, 1, 0) where
// no triangle has an area.
std::vector<glm::vec3> VertexNormals(const std::vector<glm::vec3>& positions,
                                     const std::vector<std::uint32_t>& triangles);

// What of a cloth never changes, for drawing it again and again.
class ClothShape {
 public:
  explicit ClothShape(const ClothObject& object);

  const ClothObject& object() const { return object_; }
  const Eigen::VectorXd& rest_lengths() const { return rest_lengths_; }
  const std::vector<std::array<int, 2>>& edges() const { return edges_; }
  const std::vector<std::array<int, 2>>& border() const { return border_; }

  // @param positions  3N; triangles of vertices that are NaN are left out
  // @param colors     one per vertex
  // The surface's topology has corners, so that it can be drawn with its edges.
  Surface MakeSurface(const Eigen::VectorXd& positions,
                      std::vector<glm::vec4> colors) const;

  // Lines that join vertices, of which both are known.
  // @param colors  one for all, or one per pair
  static Lines MakeLines(const Eigen::VectorXd& positions,
                         const std::vector<std::array<int, 2>>& pairs,
                         const std::vector<glm::vec4>& colors);

 private:
  // @param positions  without copies
  std::vector<glm::vec3> Normals(const std::vector<glm::vec3>& positions,
                                 const Topology& topology) const;

  ClothObject object_;
  Eigen::VectorXd rest_lengths_;
  std::vector<std::array<int, 2>> edges_;   // of triangles, each once
  std::vector<std::array<int, 2>> border_;  // those of one triangle alone
  // Of the surface, whose vertices are the cloth's and then copies of some.
  std::shared_ptr<const Topology> topology_;
  std::vector<int> copies_;  // of which vertex
};

// As the renderer takes them; (0, 0, 0) for NaN.
std::vector<glm::vec3> ToPoints(const Eigen::VectorXd& positions);
glm::vec3 ToPoint(const Eigen::Vector3d& position);

}  // namespace dpe::viewer

#endif  // DPE_VIEWER_SCENE_VIEW_CLOTH_PICTURE_H_
