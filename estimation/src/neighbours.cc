#include "neighbours.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <set>

#include "dpe/engine/cloth_builder.h"

namespace dpe {
namespace {

using Pair = std::pair<int, int>;

Pair Sorted(int a, int b) { return {std::min(a, b), std::max(a, b)}; }

// The cloth's mesh with a material of 1 by the construction rule; empty if the rule
// does not accept the mesh.
ClothObject UniformCloth(const ClothObject& cloth) {
  ClothMaterial material;
  material.traction_stiffness = material.bending_stiffness = 1.0;
  material.shear_stiffness = 1.0;
  material.density = 1.0;
  try {
    return BuildClothFromMesh({cloth.positions, cloth.triangles}, material);
  } catch (const SceneError&) {
    return {};
  }
}

struct SpringShape {
  double stiffness = 0.0;  // for a material of 1; 0: not one of the rule's
  SpringKind kind = SpringKind::kStretch;
};

// Of every spring; empty if not all of them are the rule's.
std::vector<SpringShape> SpringShapes(const ClothObject& cloth) {
  const ClothObject uniform = UniformCloth(cloth);
  std::map<Pair, SpringShape> of_pair;
  for (int s = 0; s < uniform.num_springs(); ++s) {
    // Where the rule has two springs between the same vertices, the edge is the first.
    of_pair.emplace(Sorted(uniform.springs[s][0], uniform.springs[s][1]),
                    SpringShape{uniform.stiffness[s], uniform.spring_kind[s]});
  }
  std::vector<SpringShape> shapes;
  for (const std::array<int, 2>& spring : cloth.springs) {
    const auto it = of_pair.find(Sorted(spring[0], spring[1]));
    if (it == of_pair.end() || !(it->second.stiffness > 0.0)) return {};
    shapes.push_back(it->second);
  }
  return shapes;
}

// Pairs of springs of the same kind, see the header.
class SpringPairs {
 public:
  SpringPairs(const ClothObject& cloth, const std::vector<int>& kinds)
      : cloth_(cloth), kinds_(kinds), piece_(cloth.num_springs()) {
    std::iota(piece_.begin(), piece_.end(), 0);
    for (int s = 0; s < cloth.num_springs(); ++s) {
      for (const int vertex : cloth.springs[s]) at_[{kinds[s], vertex}].push_back(s);
    }
  }

  std::vector<Pair> Find() {
    for (const auto& [place, springs] : at_) {
      for (const int b : springs) {
        for (const int a : springs) {
          if (a < b) Join(a, b);
        }
      }
    }
    const std::vector<int> piece = Pieces();  // before any of them are joined
    for (const std::array<int, 2>& joint : cloth_.springs) {
      for (const int kind : std::set<int>(kinds_.begin(), kinds_.end())) {
        for (const int a : At(kind, joint[0])) {
          for (const int b : At(kind, joint[1])) {
            if (piece[a] != piece[b]) Join(a, b);
          }
        }
      }
    }
    return {pairs_.begin(), pairs_.end()};
  }

 private:
  const std::vector<int>& At(int kind, int vertex) const {
    static const std::vector<int> none;
    const auto it = at_.find({kind, vertex});
    return it == at_.end() ? none : it->second;
  }

  int Root(int s) {
    while (piece_[s] != s) s = piece_[s] = piece_[piece_[s]];
    return s;
  }

  void Join(int a, int b) {
    pairs_.insert(Sorted(a, b));
    piece_[Root(a)] = Root(b);
  }

  std::vector<int> Pieces() {
    std::vector<int> pieces(piece_.size());
    for (size_t s = 0; s < pieces.size(); ++s) pieces[s] = Root(static_cast<int>(s));
    return pieces;
  }

  const ClothObject& cloth_;
  const std::vector<int>& kinds_;
  std::vector<int> piece_;               // a parent of each spring
  std::map<Pair, std::vector<int>> at_;  // springs by kind and vertex
  std::set<Pair> pairs_;
};

Neighbours OfSprings(const ClothObject& cloth) {
  const int n = cloth.num_springs();
  const std::vector<SpringShape> shapes = SpringShapes(cloth);
  std::vector<int> kinds = SpringGroups(cloth);
  Neighbours result;
  result.log_shape.assign(n, 0.0);
  for (int s = 0; s < n; ++s) {
    if (!shapes.empty()) {
      result.log_shape[s] = std::log(shapes[s].stiffness);
      kinds[s] = static_cast<int>(shapes[s].kind);
    }
    if (!cloth.spring_kind.empty()) kinds[s] = static_cast<int>(cloth.spring_kind[s]);
  }
  result.pairs = SpringPairs(cloth, kinds).Find();
  return result;
}

Neighbours OfVertices(const ClothObject& cloth) {
  const ClothObject uniform = UniformCloth(cloth);
  Neighbours result;
  result.log_shape.assign(cloth.num_vertices(), 0.0);
  for (int v = 0; v < static_cast<int>(uniform.mass.size()); ++v) {
    result.log_shape[v] = std::log(uniform.mass[v]);
  }
  std::set<Pair> pairs;
  for (const std::array<int, 2>& spring : cloth.springs) {
    if (spring[0] != spring[1]) pairs.insert(Sorted(spring[0], spring[1]));
  }
  result.pairs.assign(pairs.begin(), pairs.end());
  return result;
}

}  // namespace

Neighbours FindNeighbours(const ClothObject& cloth, ParameterKind kind) {
  return kind == ParameterKind::kMass ? OfVertices(cloth) : OfSprings(cloth);
}

}  // namespace dpe
