#include <cmath>
#include <limits>
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

std::vector<double> MassToKeep(const Scene& scene, const std::vector<Prior>& priors) {
  std::vector<double> masses = FreeMass(scene);
  for (const Prior& prior : priors) {
    if (prior.kind != ParameterKind::kMass && prior.kind != ParameterKind::kStiffness &&
        prior.kind != ParameterKind::kDrag) {
      continue;
    }
    for (int object = 0; object < static_cast<int>(masses.size()); ++object) {
      if (prior.object >= 0 && prior.object != object) continue;
      masses[object] = std::numeric_limits<double>::quiet_NaN();
    }
  }
  return masses;
}

bool ScaleIsFree(const Scene& scene, int object) {
  const ClothObject& cloth = scene.objects[object];
  return cloth.mass_mode != ParameterMode::kFixed &&
         cloth.stiffness_mode != ParameterMode::kFixed &&
         (cloth.drag_coefficient == 0.0 || cloth.estimate_drag) &&
         scene.colliders.empty();
}

std::string ScaleNote(int object, double free_mass) {
  std::ostringstream note;
  note << "object " << object
       << ": no known force fixes the scale of mass and stiffness; the total mass of "
          "the free vertices is kept at "
       << free_mass << " kg";
  return note.str();
}

std::vector<std::string> NormaliseScale(const Scene& scene,
                                        const ParameterLayout& layout,
                                        const std::vector<double>& free_mass,
                                        Eigen::VectorXd* parameters) {
  std::vector<std::string> notes;
  for (int object = 0; object < static_cast<int>(scene.objects.size()); ++object) {
    if (!ScaleIsFree(scene, object) || std::isnan(free_mass[object])) continue;
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
    notes.push_back(ScaleNote(object, free_mass[object]));
  }
  return notes;
}

}  // namespace dpe
