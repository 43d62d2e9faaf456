#include <cmath>
#include <sstream>

#include "starting_point.h"

namespace dpe {

std::vector<double> FreeMass(const Scene& scene) {
  std::vector<double> sums;
  for (const ClothObject& object : scene.objects) {
    double sum = 0.0;
    for (int v = 0; v < object.num_vertices(); ++v) {
      if (!object.is_fixed[v]) sum += object.mass[v];
    }
    sums.push_back(sum);
  }
  return sums;
}

bool ScaleIsFree(const Scene& scene, int object) {
  const ClothObject& cloth = scene.objects[object];
  return cloth.mass_mode != ParameterMode::kFixed &&
         cloth.stiffness_mode != ParameterMode::kFixed &&
         (cloth.drag_coefficient == 0.0 || cloth.estimate_drag) &&
         scene.colliders.empty();
}

std::vector<std::string> NormaliseScale(const Scene& scene,
                                        const ParameterLayout& layout,
                                        const std::vector<double>& free_mass,
                                        Eigen::VectorXd* parameters) {
  std::vector<std::string> notes;
  for (int object = 0; object < static_cast<int>(scene.objects.size()); ++object) {
    if (!ScaleIsFree(scene, object)) continue;
    double sum = 0.0;
    for (const ParameterBlock& block : layout.blocks()) {
      if (block.object != object || block.kind != ParameterKind::kMass) continue;
      for (int local : block.element_to_local) {
        if (local >= 0) sum += (*parameters)[block.offset + local];
      }
    }
    if (!(sum > 0.0)) continue;
    for (const ParameterBlock& block : layout.blocks()) {
      if (block.object == object && (block.kind == ParameterKind::kMass ||
                                     block.kind == ParameterKind::kStiffness ||
                                     block.kind == ParameterKind::kDrag)) {
        parameters->segment(block.offset, block.size) *= free_mass[object] / sum;
      }
    }
    std::ostringstream note;
    note << "object " << object
         << ": no known force fixes the scale of mass and stiffness; the total mass of "
            "the free vertices is kept at "
         << free_mass[object] << " kg";
    notes.push_back(note.str());
  }
  return notes;
}

}  // namespace dpe
