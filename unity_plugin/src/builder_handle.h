// A scene in the making.
#ifndef DPE_UNITY_BUILDER_HANDLE_H_
#define DPE_UNITY_BUILDER_HANDLE_H_

#include <mutex>

#include "call.h"
#include "dpe/engine/scene.h"
#include "handle_table.h"

namespace dpe::c {

class BuilderHandle : public HandleObject {
 public:
  static constexpr HandleKind kKind = HandleKind::kBuilder;

  // work(Scene&): all of it or, if it throws, nothing.
  template <class Work>
  void Change(const Work& work) {
    const std::lock_guard<std::mutex> lock(mutex_);
    Scene changed = scene_;
    work(changed);
    scene_ = std::move(changed);
  }

  Scene scene() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return scene_;
  }

 private:
  mutable std::mutex mutex_;
  Scene scene_;
};

}  // namespace dpe::c

#endif  // DPE_UNITY_BUILDER_HANDLE_H_
