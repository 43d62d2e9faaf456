#include "render/picture_checks.h"

#include <algorithm>
#include <stdexcept>
#include <string>

namespace dpe::viewer {
namespace {

void Require(bool holds, const std::string& what) {
  if (!holds) throw std::invalid_argument("Picture: " + what);
}

}  // namespace

bool IsEmpty(const Surface& surface) {
  return !surface.topology || surface.topology->triangles.empty();
}

void CheckPicture(const Picture& picture) {
  for (const Surface& surface : picture.surfaces) {
    Require(surface.normals.size() == surface.positions.size(),
            "a surface needs one normal per vertex");
    Require(surface.colors.size() == surface.positions.size(),
            "a surface needs one color per vertex");
    Require(surface.edge_width <= 0.0f || IsEmpty(surface) ||
                surface.topology->corners.size() == surface.positions.size(),
            "a surface with edges needs one corner per vertex");
  }
  for (const Lines& lines : picture.lines) {
    Require(lines.positions.size() % 2 == 0, "lines need two vertices per segment");
    Require(lines.colors.size() == lines.positions.size(),
            "lines need one color per vertex");
  }
}

std::size_t VerticesNeeded(const Topology& topology) {
  Require(topology.triangles.size() % 3 == 0, "a triangle has three vertices");
  const auto last =
      std::max_element(topology.triangles.begin(), topology.triangles.end());
  return last == topology.triangles.end() ? 0 : std::size_t{*last} + 1;
}

}  // namespace dpe::viewer
