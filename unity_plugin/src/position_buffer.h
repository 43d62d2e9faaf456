// The newest positions of all objects, between the thread that computes them and those
// who show them. Nobody waits for a computation: the lock is held while numbers are
// copied, and no longer.
#ifndef DPE_UNITY_POSITION_BUFFER_H_
#define DPE_UNITY_POSITION_BUFFER_H_

#include <Eigen/Core>
#include <cstdint>
#include <mutex>
#include <vector>

#include "dpe/engine/scene.h"

namespace dpe::c {

// What a reader knows and is told, see dpe_scene_copy_positions.
struct PositionReader {
  float* positions = nullptr;
  int capacity = 0;
  std::uint64_t sequence = 0;
  std::int64_t frame = 0;
  bool is_new = false;
};

class PositionBuffer {
 public:
  // Of all objects of the scene.
  explicit PositionBuffer(const Scene& scene);

  int num_objects() const { return num_objects_; }

  // One writer at a time: the next state of an object, 3N, m ...
  void Write(int object, const double* positions);
  // ... and that all are written: from now on they are the newest.
  void Publish(std::int64_t frame);

  std::int64_t frame() const;
  // @throws ApiError for a wrong object or too small a buffer
  void Copy(int object, PositionReader* reader) const;

 private:
  const int num_objects_;
  std::vector<std::vector<float>> back_;  // of the writer
  mutable std::mutex mutex_;              // guards what follows
  std::vector<std::vector<float>> front_;
  std::uint64_t sequence_ = 0;
  std::int64_t frame_ = 0;
};

// PositionBuffer::Copy as the C interface offers it.
void CopyPositions(const PositionBuffer& from, int object, float* positions,
                   int capacity, std::uint64_t* sequence, std::int64_t* frame,
                   std::int32_t* is_new);

}  // namespace dpe::c

#endif  // DPE_UNITY_POSITION_BUFFER_H_
