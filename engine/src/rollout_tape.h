// What a rollout keeps for its derivative passes beside the trajectory: states between
// frames and factorised step matrices, as many as the memory limit allows
// (memory_plan.h). What is not kept, passes make again.
#ifndef DPE_ENGINE_ROLLOUT_TAPE_H_
#define DPE_ENGINE_ROLLOUT_TAPE_H_

#include <cstddef>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

#include "inner_states.h"
#include "linear/kept_factor.h"

namespace dpe {

// Factors that earlier rollouts of an object have handed back; their memory serves
// again.
class FactorPool {
 public:
  // Up to `count`, empty ones.
  //
  // @param bytes  of each; where that changes, those of another size are given up
  std::vector<std::unique_ptr<KeptFactor>> Take(int count, std::size_t bytes) {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (bytes != bytes_) factors_.clear();
    bytes_ = bytes;
    std::vector<std::unique_ptr<KeptFactor>> taken;
    for (; count > 0 && !factors_.empty(); --count) {
      factors_.back()->Clear();
      taken.push_back(std::move(factors_.back()));
      factors_.pop_back();
    }
    return taken;
  }
  void Return(std::unique_ptr<KeptFactor> factor, std::size_t bytes) {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (bytes == bytes_) factors_.push_back(std::move(factor));
  }

 private:
  std::mutex mutex_;
  std::size_t bytes_ = 0;
  std::vector<std::unique_ptr<KeptFactor>> factors_;
};

struct ObjectTape {
  ObjectTape() = default;
  ObjectTape(ObjectTape&&) = default;
  ObjectTape& operator=(ObjectTape&&) = default;
  ~ObjectTape() {
    for (auto& factor : factors) {
      if (factor) pool->Return(std::move(factor), bytes_per_factor);
    }
  }

  // Of the first frames.
  InnerStates inner;
  // factors[s] is the factorisation that step s made, of the first steps.
  std::vector<std::unique_ptr<KeptFactor>> factors;
  std::size_t bytes_per_factor = 0;
  std::shared_ptr<FactorPool> pool;
};

class RolloutTape {
 public:
  std::vector<ObjectTape> objects;

  std::size_t bytes() const {
    std::size_t sum = 0;
    for (const ObjectTape& tape : objects) {
      sum += tape.inner.bytes() + tape.factors.size() * tape.bytes_per_factor;
    }
    return sum;
  }
};

}  // namespace dpe

#endif  // DPE_ENGINE_ROLLOUT_TAPE_H_
