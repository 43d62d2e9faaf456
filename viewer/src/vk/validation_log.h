// Collects what the validation layer and the driver have to say.
#ifndef DPE_VIEWER_VK_VALIDATION_LOG_H_
#define DPE_VIEWER_VK_VALIDATION_LOG_H_

#include <mutex>
#include <string>
#include <vector>

namespace dpe::viewer {

// Warnings and errors, in the order in which they came. Drivers report from their own
// threads, so every member may be called from any thread.
class ValidationLog {
 public:
  void Add(std::string message);
  std::vector<std::string> messages() const;
  bool empty() const;
  void Clear();

 private:
  mutable std::mutex mutex_;
  std::vector<std::string> messages_;
};

}  // namespace dpe::viewer

#endif  // DPE_VIEWER_VK_VALIDATION_LOG_H_
