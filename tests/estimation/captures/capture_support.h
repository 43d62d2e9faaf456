// What the tests of captures share.
#ifndef DPE_TESTS_ESTIMATION_CAPTURES_CAPTURE_SUPPORT_H_
#define DPE_TESTS_ESTIMATION_CAPTURES_CAPTURE_SUPPORT_H_

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "dpe/engine/scene.h"
#include "dpe/estimation/capture.h"
#include "support/temp_dir.h"

namespace dpe::test {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::StartsWith;

// The message of the SceneError that `action` throws; "accepted" if it throws none.
template <typename Action>
std::string ErrorOf(const Action& action) {
  try {
    action();
  } catch (const SceneError& error) {
    return error.what();
  }
  return "accepted";
}

class CaptureTest : public ::testing::Test {
 protected:
  Capture Read(const std::string& content) {
    WriteFile(path_, content);
    return ReadCapture(path_, options_);
  }
  std::string ErrorOfReading(const std::string& content) {
    return ErrorOf([&] { Read(content); });
  }

  const TempDir dir_;
  // The name says nothing: formats are recognised by content.
  const std::string path_ = dir_.File("capture.dat");
  CaptureOptions options_;
};

}  // namespace dpe::test

#endif  // DPE_TESTS_ESTIMATION_CAPTURES_CAPTURE_SUPPORT_H_
