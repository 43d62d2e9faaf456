#include "validation/collider_validation.h"

#include <string>

namespace dpe {

void ValidateColliders(const std::vector<Collider>& colliders,
                       const ValidationReport& report) {
  for (size_t i = 0; i < colliders.size(); ++i) {
    const Collider& collider = colliders[i];
    const std::string path = "colliders[" + std::to_string(i) + "]";
    report.RequireFinite(path + ".pos", collider.position);
    report.RequireFinite(path + ".rot", collider.rotation_degrees);
    report.RequireFinite(path + ".scale", collider.scale);
    if (collider.type == ColliderType::kSphere) {
      report.RequirePositive(path + ".scale.x", collider.scale.x(),
                             "a finite diameter of the sphere > 0 m");
    }
    report.RequireNotNegative(path + ".stiffness", collider.stiffness,
                              "a finite stiffness >= 0 N/m");
  }
}

}  // namespace dpe
