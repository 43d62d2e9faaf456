#include "playback/triple_buffer.h"

#include <gtest/gtest.h>

#include <thread>
#include <vector>

namespace dpe::viewer {
namespace {

TEST(TripleBufferTest, ReaderSeesTheNewestValueOnce) {
  TripleBuffer<int> buffer(-1);
  EXPECT_FALSE(buffer.Update());
  EXPECT_EQ(buffer.front(), -1);
  for (const int value : {1, 2, 3}) {
    buffer.back() = value;
    buffer.Publish();
  }
  EXPECT_TRUE(buffer.Update());
  EXPECT_EQ(buffer.front(), 3);
  EXPECT_FALSE(buffer.Update());
  // What is being written is not what is being read.
  buffer.back() = 4;
  EXPECT_EQ(buffer.front(), 3);
  buffer.Publish();
  EXPECT_TRUE(buffer.Update());
  EXPECT_EQ(buffer.front(), 4);
}

TEST(TripleBufferTest, ValuesOfAnotherThreadAreWholeAndInOrder) {
  constexpr int kCount = 20000, kSize = 64;
  TripleBuffer<std::vector<int>> buffer(std::vector<int>(kSize, 0));
  std::thread writer([&] {
    for (int value = 1; value <= kCount; ++value) {
      std::vector<int>& slot = buffer.back();
      for (int& element : slot) element = value;
      buffer.Publish();
    }
  });
  int last = 0, torn = 0, backwards = 0;
  while (last < kCount) {
    if (!buffer.Update()) {
      std::this_thread::yield();
      continue;
    }
    const std::vector<int>& slot = buffer.front();
    for (const int element : slot) torn += element != slot[0];
    backwards += slot[0] <= last;
    last = slot[0];
  }
  writer.join();
  EXPECT_EQ(torn, 0);
  EXPECT_EQ(backwards, 0);
  EXPECT_EQ(last, kCount);
}

}  // namespace
}  // namespace dpe::viewer
