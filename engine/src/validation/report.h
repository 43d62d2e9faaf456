// How validation speaks: "FILE: PATH: VALUE is not accepted; expected ...".
#ifndef DPE_ENGINE_SRC_VALIDATION_REPORT_H_
#define DPE_ENGINE_SRC_VALIDATION_REPORT_H_

#include <Eigen/Core>
#include <string>
#include <vector>

#include "dpe/engine/scene.h"

namespace dpe {

class ValidationReport {
 public:
  // @param file      stands before each message
  // @param warnings  may be null
  ValidationReport(const std::string& file, std::vector<std::string>* warnings)
      : file_(file), warnings_(warnings) {}

  // @param path  JSON path of the value, like objects[0].vertMass[3]
  [[noreturn]] void Fail(const std::string& path, const std::string& value,
                         const std::string& accepted) const;
  void Warn(const std::string& path, const std::string& message) const;

  void RequireFinite(const std::string& path, double value) const;
  void RequireFinite(const std::string& path, const Eigen::Vector3d& value) const;
  // Finite and > 0, or >= 0. @param what  with unit, "a length > 0 s"
  void RequirePositive(const std::string& path, double value,
                       const std::string& what) const;
  void RequireNotNegative(const std::string& path, double value,
                          const std::string& what) const;
  // The number of entries of an array. @param per  "one per vertex"
  void RequireSize(const std::string& path, long size, long expected,
                   const std::string& per) const;

 private:
  const std::string& file_;
  std::vector<std::string>* warnings_;
};

}  // namespace dpe

#endif  // DPE_ENGINE_SRC_VALIDATION_REPORT_H_
