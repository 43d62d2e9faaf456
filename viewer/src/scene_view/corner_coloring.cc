#include "scene_view/corner_coloring.h"

#include <algorithm>
#include <tuple>
#include <utility>

namespace dpe::viewer {
namespace {

using Triangles = std::vector<std::array<int, 3>>;

constexpr std::uint32_t kNone = ~std::uint32_t{0};

// A side of a triangle: its vertices in order, and whose it is.
struct Side {
  int low, high;
  int triangle;

  bool operator<(const Side& other) const {
    return std::tie(low, high, triangle) <
           std::tie(other.low, other.high, other.triangle);
  }
};

Side SideOf(const Triangles& triangles, int triangle, int k) {
  const int a = triangles[triangle][k], b = triangles[triangle][(k + 1) % 3];
  return {std::min(a, b), std::max(a, b), triangle};
}

class Coloring {
 public:
  Coloring(const Triangles& triangles, int num_vertices)
      : triangles_(triangles), as_(num_vertices, {kNone, kNone, kNone}) {
    for (int t = 0; t < static_cast<int>(triangles.size()); ++t) {
      for (int k = 0; k < 3; ++k) sides_.push_back(SideOf(triangles, t, k));
    }
    std::sort(sides_.begin(), sides_.end());
    result_.triangles.resize(triangles.size(), {kNone, kNone, kNone});
    result_.corners.assign(num_vertices, kNone);
  }

  CornerColoring Take() {
    for (int t = 0; t < static_cast<int>(triangles_.size()); ++t) {
      if (IsDone(t)) continue;
      Color(t, {0, 1, 2});
      while (!waiting_.empty()) {
        const int next = waiting_.back();
        waiting_.pop_back();
        GoOn(next);
      }
    }
    // Of no triangle.
    std::replace(result_.corners.begin(), result_.corners.end(), kNone, 0U);
    return std::move(result_);
  }

 private:
  bool IsDone(int t) const { return result_.triangles[t][0] != kNone; }

  // The vertex as one with that corner's number: itself, or a copy.
  std::uint32_t As(int vertex, std::uint32_t corner) {
    std::uint32_t& index = as_[vertex][corner];
    if (index != kNone) return index;
    if (result_.corners[vertex] == kNone) {
      index = vertex;
      result_.corners[vertex] = corner;
    } else {
      index = static_cast<std::uint32_t>(result_.corners.size());
      result_.corners.push_back(corner);
      result_.copies.push_back(vertex);
    }
    return index;
  }

  void Color(int t, const std::array<std::uint32_t, 3>& corners) {
    for (int k = 0; k < 3; ++k) {
      result_.triangles[t][k] = As(triangles_[t][k], corners[k]);
    }
    waiting_.push_back(t);
  }

  // Colours what lies across the sides of a triangle that is coloured.
  void GoOn(int t) {
    for (int k = 0; k < 3; ++k) {
      const Side side = SideOf(triangles_, t, k);
      const auto first =
          std::lower_bound(sides_.begin(), sides_.end(), Side{side.low, side.high, -1});
      for (auto s = first;
           s != sides_.end() && s->low == side.low && s->high == side.high; ++s) {
        if (!IsDone(s->triangle)) Color(s->triangle, Across(t, s->triangle));
      }
    }
  }

  // Shared vertices keep their numbers, the other one gets the one that is left.
  std::array<std::uint32_t, 3> Across(int from, int to) const {
    std::array<std::uint32_t, 3> corners{kNone, kNone, kNone};
    std::uint32_t left = 3;
    for (int k = 0; k < 3; ++k) {
      const auto& of = triangles_[from];
      const auto place = std::find(of.begin(), of.end(), triangles_[to][k]);
      if (place == of.end()) continue;
      corners[k] = result_.corners[result_.triangles[from][place - of.begin()]];
      left -= corners[k];
    }
    std::replace(corners.begin(), corners.end(), kNone, left);
    return corners;
  }

  const Triangles& triangles_;
  std::vector<Side> sides_;  // sorted
  std::vector<std::array<std::uint32_t, 3>> as_;
  std::vector<int> waiting_;
  CornerColoring result_;
};

}  // namespace

CornerColoring ColorCorners(const std::vector<std::array<int, 3>>& triangles,
                            int num_vertices) {
  return Coloring(triangles, num_vertices).Take();
}

}  // namespace dpe::viewer
