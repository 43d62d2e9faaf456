#include "handle_table.h"

#include <stdexcept>
#include <utility>

namespace dpe::c {
namespace {

constexpr int kSlotBits = 24;
constexpr int kGenerationBits = 32;

dpe_handle MakeHandle(HandleKind kind, std::uint32_t generation, int slot) {
  return static_cast<dpe_handle>(kind) << (kSlotBits + kGenerationBits) |
         static_cast<dpe_handle>(generation) << kSlotBits |
         static_cast<dpe_handle>(slot);
}

}  // namespace

HandleTable& HandleTable::Global() {
  static HandleTable table;
  return table;
}

dpe_handle HandleTable::Add(HandleKind kind, std::shared_ptr<HandleObject> object) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (free_.empty()) {
    const std::size_t slot = slots_.size();
    if (slot >> kSlotBits != 0) throw std::length_error("too many handles");
    // Room for handing slots back, which must not fail.
    free_.reserve(slot + 1);
    slots_.emplace_back();
    free_.push_back(static_cast<int>(slot));
  }
  const int slot = free_.back();
  free_.pop_back();
  slots_[slot].kind = kind;
  slots_[slot].object = std::move(object);
  return MakeHandle(kind, slots_[slot].generation, slot);
}

const HandleTable::Slot* HandleTable::SlotOf(dpe_handle handle) const {
  const std::size_t slot = handle & ((dpe_handle{1} << kSlotBits) - 1);
  if (slot >= slots_.size() || !slots_[slot].object) return nullptr;
  const Slot& found = slots_[slot];
  const bool is_it =
      MakeHandle(found.kind, found.generation, static_cast<int>(slot)) == handle;
  return is_it ? &found : nullptr;
}

std::shared_ptr<HandleObject> HandleTable::Find(dpe_handle handle) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  const Slot* slot = SlotOf(handle);
  return slot != nullptr ? slot->object : nullptr;
}

std::shared_ptr<HandleObject> HandleTable::Take(int slot) {
  ++slots_[slot].generation;
  free_.push_back(slot);
  return std::move(slots_[slot].object);
}

bool HandleTable::Destroy(dpe_handle handle, HandleKind kind) {
  std::shared_ptr<HandleObject> object;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    const Slot* slot = SlotOf(handle);
    if (slot == nullptr || slot->kind != kind) return false;
    object = Take(static_cast<int>(slot - slots_.data()));
  }
  // Not under the lock: this may wait for a thread that looks up a handle.
  object->Close();
  return true;
}

void HandleTable::CloseAll() {
  std::vector<std::shared_ptr<HandleObject>> objects;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    for (std::size_t slot = 0; slot < slots_.size(); ++slot) {
      if (slots_[slot].object) objects.push_back(Take(static_cast<int>(slot)));
    }
  }
  for (const auto& object : objects) object->Close();
  std::vector<std::thread> adopted;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    adopted.swap(adopted_);
  }
  for (std::thread& thread : adopted) {
    if (thread.get_id() == std::this_thread::get_id()) {
      Adopt(std::move(thread));
    } else {
      thread.join();
    }
  }
}

void HandleTable::Adopt(std::thread thread) {
  const std::lock_guard<std::mutex> lock(mutex_);
  adopted_.push_back(std::move(thread));
}

int HandleTable::size() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return static_cast<int>(slots_.size() - free_.size());
}

}  // namespace dpe::c
