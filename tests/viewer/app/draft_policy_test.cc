#include "app/draft_policy.h"

#include <gtest/gtest.h>

namespace dpe::viewer {
namespace {

constexpr double kSlow = 1.1 * DraftPolicy::kLongest;
constexpr double kQuick = 0.9 * DraftPolicy::kLongest / DraftPolicy::kMostRatio;

// Draws so many; how many of them were drafts.
int Draw(int count, bool moving, double seconds, DraftPolicy* policy) {
  int drafts = 0;
  for (int k = 0; k < count; ++k) {
    drafts += policy->Next(moving);
    policy->Took(seconds);
  }
  return drafts;
}

TEST(DraftPolicyTest, DraftsFollowSlowPicturesUntilThingsStandStill) {
  DraftPolicy policy;
  EXPECT_EQ(Draw(100, true, 0.9 * DraftPolicy::kLongest, &policy), 0);
  EXPECT_EQ(Draw(10, true, kSlow, &policy), 10 - DraftPolicy::kSlowInARow);
  EXPECT_TRUE(policy.Next(true));
  EXPECT_EQ(Draw(5, false, kSlow, &policy), 0);
  EXPECT_FALSE(policy.Next(true));
}

TEST(DraftPolicyTest, OneSlowPictureIsNoReason) {
  DraftPolicy policy;
  for (int k = 0; k < 10; ++k) {
    EXPECT_EQ(Draw(DraftPolicy::kSlowInARow - 1, true, kSlow, &policy), 0);
    EXPECT_EQ(Draw(1, true, kQuick, &policy), 0);
  }
}

TEST(DraftPolicyTest, DraftsEndWhenFullPicturesWouldKeepUp) {
  DraftPolicy policy;
  Draw(DraftPolicy::kSlowInARow, true, kSlow, &policy);
  EXPECT_EQ(Draw(200, true, 1.2 * kQuick, &policy), 200);  // not quick enough
  EXPECT_EQ(Draw(200, true, kQuick, &policy), DraftPolicy::kQuickInARow);
}

}  // namespace
}  // namespace dpe::viewer
