#include "app/draft_policy.h"

#include <gtest/gtest.h>

namespace dpe::viewer {
namespace {

TEST(DraftPolicyTest, DraftsFollowASlowPictureUntilThingsStandStill) {
  DraftPolicy policy;
  EXPECT_FALSE(policy.Next(true));
  policy.Took(0.9 * DraftPolicy::kLongest);
  EXPECT_FALSE(policy.Next(true));
  policy.Took(1.1 * DraftPolicy::kLongest);
  EXPECT_TRUE(policy.Next(true));
  policy.Took(0.2 * DraftPolicy::kLongest);  // because it is a draft
  EXPECT_TRUE(policy.Next(true));
  EXPECT_FALSE(policy.Next(false));
  policy.Took(3.0 * DraftPolicy::kLongest);  // standing still, in full
  EXPECT_FALSE(policy.Next(false));
  EXPECT_FALSE(policy.Next(true));
}

}  // namespace
}  // namespace dpe::viewer
