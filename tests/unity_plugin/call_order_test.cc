// The interface is called in random order with random arguments; fuzz/call_order.h says
// what has to hold. fuzz/call_order_fuzzer.cc searches on where these seeds stop.
#include "fuzz/call_order.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "support/sanitizers.h"
#include "support/temp_dir.h"

namespace dpe::test {
namespace {

std::string RunSeeds(const CallOrderFiles& files, unsigned first, unsigned count) {
  for (unsigned seed = first; seed < first + count; ++seed) {
    std::mt19937 random(seed);
    std::vector<std::uint8_t> bytes(1200);
    for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(random() >> 24);
    const std::string failure = RunCallOrder(files, bytes.data(), bytes.size());
    if (!failure.empty()) return "seed " + std::to_string(seed) + ": " + failure;
  }
  return "";
}

TEST(CallOrderTest, AnyOrderGivesAStatus) {
#ifdef DPE_TEST_SANITIZED
  constexpr unsigned kSeeds = 40;
#else
  constexpr unsigned kSeeds = 200;
#endif
  const TempDir folder;
  EXPECT_EQ(RunSeeds(MakeCallOrderFiles(folder.path()), 1, kSeeds), "");
  EXPECT_GT(NumCalls(), 60);
}

TEST(CallOrderTest, LongAnyOrderGivesAStatus) {
  const TempDir folder;
  EXPECT_EQ(RunSeeds(MakeCallOrderFiles(folder.path()), 1000, 2000), "");
}

}  // namespace
}  // namespace dpe::test
