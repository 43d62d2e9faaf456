// The point of a triangle mesh that is nearest to a point in space.
#ifndef DPE_ESTIMATION_SRC_CAPTURES_NEAREST_TRIANGLE_H_
#define DPE_ESTIMATION_SRC_CAPTURES_NEAREST_TRIANGLE_H_

#include <Eigen/Core>

#include "dpe/engine/scene.h"

namespace dpe {

// Barycentric coordinates (sum 1, each from 0 to 1) of the point of triangle (a, b, c)
// that is nearest to p. On an edge or a corner the coordinates of the other corners are
// exactly 0.
// Source: Ericson, Real-Time Collision Detection (2005), section 5.1.5.
Eigen::Vector3d NearestInTriangle(const Eigen::Vector3d& p, const Eigen::Vector3d& a,
                                  const Eigen::Vector3d& b, const Eigen::Vector3d& c);

struct NearestPoint {
  int triangle = -1;  // -1: the object has none
  Eigen::Vector3d weights = Eigen::Vector3d::Zero();
  double distance = 0.0;  // m
};

// The first of the nearest triangles of the object's initial state.
NearestPoint FindNearestTriangle(const Eigen::Vector3d& p, const ClothObject& object);

// Mean length of the edges of all triangles of the object, m, each triangle's three
// counted; 0 without triangles.
double MeanEdgeLength(const ClothObject& object);

}  // namespace dpe

#endif  // DPE_ESTIMATION_SRC_CAPTURES_NEAREST_TRIANGLE_H_
