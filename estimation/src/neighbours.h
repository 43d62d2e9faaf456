// Which elements of a cloth are neighbours, and what geometry alone makes of their
// ratio.
#ifndef DPE_ESTIMATION_NEIGHBOURS_H_
#define DPE_ESTIMATION_NEIGHBOURS_H_

#include <utility>
#include <vector>

#include "dpe/engine/parameters.h"
#include "dpe/engine/scene.h"

namespace dpe {

// See priors.h for what they are neighbours for.
struct Neighbours {
  // Elements a < b, each pair once, in ascending order. Springs: of the same kind, with
  // a vertex in common; and, where that leaves a kind in several pieces (the diagonals
  // of a grid only touch along their own line), springs of different pieces with
  // vertices that some spring joins. Vertices: joined by a spring.
  std::vector<std::pair<int, int>> pairs;
  // ln h for each element: what a uniform material would give it, up to a factor.
  std::vector<double> log_shape;
};

// @param kind  kStiffness (elements are springs) or kMass (vertices)
Neighbours FindNeighbours(const ClothObject& cloth, ParameterKind kind);

}  // namespace dpe

#endif  // DPE_ESTIMATION_NEIGHBOURS_H_
