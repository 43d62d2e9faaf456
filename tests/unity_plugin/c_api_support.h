// What tests of the C interface share.
#ifndef DPE_TESTS_UNITY_PLUGIN_C_API_SUPPORT_H_
#define DPE_TESTS_UNITY_PLUGIN_C_API_SUPPORT_H_

#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <vector>

#include "dpe/dpe_c.h"

#define EXPECT_DPE_OK(call) EXPECT_EQ(call, DPE_OK) << dpe::test::LastError()
#define ASSERT_DPE_OK(call) ASSERT_EQ(call, DPE_OK) << dpe::test::LastError()

namespace dpe::test {

inline std::string LastError(dpe_handle handle = 0) {
  std::vector<char> text(4096);
  const auto size = static_cast<std::int32_t>(text.size());
  return dpe_last_error(handle, text.data(), size, nullptr) == DPE_OK ? text.data()
                                                                      : "no message";
}

// The newest positions of an object, and which they are.
struct ReadPositions {
  std::vector<float> positions;
  std::uint64_t sequence = 0;
  std::int64_t frame = -1;
  std::int32_t is_new = 0;
};

// A handle that is destroyed at the end of a test.
class OwnedHandle {
 public:
  explicit OwnedHandle(dpe_status (*destroy)(dpe_handle)) : destroy_(destroy) {}
  ~OwnedHandle() { destroy_(handle_); }
  OwnedHandle(const OwnedHandle&) = delete;
  OwnedHandle& operator=(const OwnedHandle&) = delete;
  dpe_handle* operator&() { return &handle_; }
  operator dpe_handle() const { return handle_; }

 private:
  dpe_status (*destroy_)(dpe_handle);
  dpe_handle handle_ = 0;
};

class OwnedScene : public OwnedHandle {
 public:
  OwnedScene() : OwnedHandle(dpe_scene_destroy) {}
};

inline ReadPositions Read(dpe_scene scene, int object, int num_vertices,
                          std::uint64_t sequence = 0) {
  ReadPositions read;
  read.positions.resize(3 * num_vertices);
  read.sequence = sequence;
  EXPECT_DPE_OK(
      dpe_scene_copy_positions(scene, object, read.positions.data(),
                               static_cast<std::int32_t>(read.positions.size()),
                               &read.sequence, &read.frame, &read.is_new));
  return read;
}

}  // namespace dpe::test

#endif  // DPE_TESTS_UNITY_PLUGIN_C_API_SUPPORT_H_
