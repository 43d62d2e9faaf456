// Renderers with the validation layer on.
#ifndef DPE_TESTS_VIEWER_VALIDATED_H_
#define DPE_TESTS_VIEWER_VALIDATED_H_

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "vk/device_options.h"

namespace dpe::viewer {

// After each test the layer must have had nothing to say, also not about what was left
// over; renderers have to end inside of the test.
class ValidatedTest : public ::testing::Test {
 protected:
  ValidatedTest() {
    options_.validation = true;
    options_.log = std::make_shared<ValidationLog>();
  }
  void TearDown() override {
    EXPECT_THAT(options_.log->messages(), ::testing::IsEmpty());
  }

  DeviceOptions options_;
};

}  // namespace dpe::viewer

#endif  // DPE_TESTS_VIEWER_VALIDATED_H_
