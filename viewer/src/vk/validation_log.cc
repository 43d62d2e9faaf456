#include "vk/validation_log.h"

#include <utility>

namespace dpe::viewer {

void ValidationLog::Add(std::string message) {
  const std::lock_guard<std::mutex> lock(mutex_);
  messages_.push_back(std::move(message));
}

std::vector<std::string> ValidationLog::messages() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return messages_;
}

bool ValidationLog::empty() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return messages_.empty();
}

void ValidationLog::Clear() {
  const std::lock_guard<std::mutex> lock(mutex_);
  messages_.clear();
}

}  // namespace dpe::viewer
