#include <gtest/gtest.h>

#include "experiments/record.h"

namespace dpe::experiments {
namespace {

TEST(RecordTest, EveryTypeIsStoredAsItIs) {
  Record record;
  record.Set("number", 0.5);
  record.Set("whole", 7);
  record.Set("long", std::int64_t{1} << 40);
  record.Set("flag", true);
  record.Set("literal", "text");
  record.Set("text", std::string("more"));
  EXPECT_EQ(std::get<double>(*record.Find("number")), 0.5);
  EXPECT_EQ(std::get<std::int64_t>(*record.Find("whole")), 7);
  EXPECT_EQ(std::get<std::int64_t>(*record.Find("long")), std::int64_t{1} << 40);
  EXPECT_EQ(std::get<bool>(*record.Find("flag")), true);
  EXPECT_EQ(record.Text("literal", ""), "text");
  EXPECT_EQ(record.Text("text", ""), "more");
}

}  // namespace
}  // namespace dpe::experiments
