#include "validation/report.h"

#include <cmath>

#include "io/number_text.h"

namespace dpe {

void ValidationReport::Fail(const std::string& path, const std::string& value,
                            const std::string& accepted) const {
  throw SceneError(file_ + ": " + path + ": " + value + " is not accepted; expected " +
                   accepted);
}

void ValidationReport::Warn(const std::string& path, const std::string& message) const {
  if (warnings_ != nullptr) warnings_->push_back(file_ + ": " + path + ": " + message);
}

void ValidationReport::RequireFinite(const std::string& path, double value) const {
  if (!std::isfinite(value)) Fail(path, NumberText(value), "a finite number");
}

void ValidationReport::RequireFinite(const std::string& path,
                                     const Eigen::Vector3d& value) const {
  RequireFinite(path + ".x", value.x());
  RequireFinite(path + ".y", value.y());
  RequireFinite(path + ".z", value.z());
}

void ValidationReport::RequirePositive(const std::string& path, double value,
                                       const std::string& what) const {
  if (!std::isfinite(value) || value <= 0.0) Fail(path, NumberText(value), what);
}

void ValidationReport::RequireNotNegative(const std::string& path, double value,
                                          const std::string& what) const {
  if (!std::isfinite(value) || value < 0.0) Fail(path, NumberText(value), what);
}

void ValidationReport::RequireSize(const std::string& path, long size, long expected,
                                   const std::string& per) const {
  if (size == expected) return;
  Fail(path, "an array of " + std::to_string(size) + " entries",
       std::to_string(expected) + ", " + per);
}

}  // namespace dpe
