#include <cmath>
#include <limits>
#include <sstream>

#include "starting_point.h"

namespace dpe {

namespace {

// Relative; total masses may come from files of few digits.
constexpr double kSameMass = 1e-6;

bool ScaleIsFreeIn(const Scene& scene, int object) {
  const ClothObject& cloth = scene.objects[object];
  return cloth.mass_mode != ParameterMode::kFixed &&
         cloth.stiffness_mode != ParameterMode::kFixed &&
         (cloth.drag_coefficient == 0.0 || cloth.estimate_drag) &&
         scene.colliders.empty();
}

// Where the masses are what is kept, captures that give different ones contradict each
// other.
void RequireSameMass(const CaptureView& first, const CaptureView& other, int object) {
  const ClothObject& a = first.scene->objects[object];
  const ClothObject& b = other.scene->objects[object];
  double of_first = 0.0, of_other = 0.0;
  for (int v = 0; v < a.num_vertices(); ++v) {
    if (a.is_fixed[v] || b.is_fixed[v]) continue;
    of_first += a.mass[v];
    of_other += b.mass[v];
  }
  if (std::abs(of_first - of_other) <= kSameMass * of_first) return;
  std::ostringstream message;
  message << "no known force fixes the scale of mass and stiffness of object " << object
          << ", so that its total mass is kept, and " << first.name << " and "
          << other.name << " give two: the vertices that are free in both have "
          << of_first << " kg and " << of_other << " kg; accepted are equal ones";
  throw SceneError(message.str());
}

}  // namespace

std::vector<double> FreeMass(const std::vector<CaptureView>& captures) {
  std::vector<double> sums;
  const int num_objects = static_cast<int>(captures[0].scene->objects.size());
  for (int object = 0; object < num_objects; ++object) {
    double sum = 0.0;
    const int num_vertices = captures[0].scene->objects[object].num_vertices();
    for (int v = 0; v < num_vertices; ++v) {
      for (const CaptureView& capture : captures) {
        const ClothObject& cloth = capture.scene->objects[object];
        if (cloth.is_fixed[v]) continue;
        sum += cloth.mass[v];
        break;
      }
    }
    sums.push_back(sum);
  }
  return sums;
}

bool ScaleIsFree(const std::vector<CaptureView>& captures, int object) {
  for (const CaptureView& capture : captures) {
    if (!ScaleIsFreeIn(*capture.scene, object)) return false;
  }
  return true;
}

void RequireOneMass(const std::vector<CaptureView>& captures) {
  const int num_objects = static_cast<int>(captures[0].scene->objects.size());
  for (int object = 0; object < num_objects; ++object) {
    if (!ScaleIsFree(captures, object)) continue;
    for (size_t c = 1; c < captures.size(); ++c) {
      RequireSameMass(captures[0], captures[c], object);
    }
  }
}

std::vector<double> MassToKeep(const std::vector<CaptureView>& captures,
                               const std::vector<Prior>& priors) {
  std::vector<double> masses = FreeMass(captures);
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

std::string ScaleNote(int object, double free_mass) {
  std::ostringstream note;
  note << "object " << object
       << ": no known force fixes the scale of mass and stiffness; the total mass of "
          "the free vertices is kept at "
       << free_mass << " kg";
  return note.str();
}

std::vector<std::string> NormaliseScale(const std::vector<CaptureView>& captures,
                                        const ParameterLayout& layout,
                                        const std::vector<double>& free_mass,
                                        Eigen::VectorXd* parameters) {
  std::vector<std::string> notes;
  for (int object = 0; object < static_cast<int>(free_mass.size()); ++object) {
    if (!ScaleIsFree(captures, object) || std::isnan(free_mass[object])) continue;
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
