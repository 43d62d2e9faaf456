#include "position_buffer.h"

#include <algorithm>

#include "call.h"

namespace dpe::c {

PositionBuffer::PositionBuffer(const Scene& scene)
    : num_objects_(static_cast<int>(scene.objects.size())) {
  for (const ClothObject& cloth : scene.objects) {
    back_.emplace_back(3 * cloth.num_vertices());
  }
  front_ = back_;
}

void PositionBuffer::Write(int object, const double* positions) {
  std::vector<float>& to = back_[object];
  for (std::size_t i = 0; i < to.size(); ++i) to[i] = static_cast<float>(positions[i]);
}

void PositionBuffer::Publish(std::int64_t frame) {
  const std::lock_guard<std::mutex> lock(mutex_);
  std::swap(front_, back_);
  frame_ = frame;
  ++sequence_;
}

std::int64_t PositionBuffer::frame() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return frame_;
}

void PositionBuffer::Copy(int object, PositionReader* reader) const {
  RequireIndex("object", object, num_objects());
  const std::lock_guard<std::mutex> lock(mutex_);
  const std::vector<float>& from = front_[object];
  reader->frame = frame_;
  reader->is_new = reader->sequence != sequence_;
  if (!reader->is_new) return;
  CopyNumbers(from.data(), static_cast<long>(from.size()), reader->positions,
              reader->capacity, nullptr);
  reader->sequence = sequence_;
}

void CopyPositions(const PositionBuffer& from, int object, float* positions,
                   int capacity, std::uint64_t* sequence, std::int64_t* frame,
                   std::int32_t* is_new) {
  Require(sequence != nullptr && is_new != nullptr, "sequence or is_new is null");
  PositionReader reader{positions, capacity, *sequence};
  from.Copy(object, &reader);
  *sequence = reader.sequence;
  if (frame != nullptr) *frame = reader.frame;
  *is_new = reader.is_new ? 1 : 0;
}

}  // namespace dpe::c
