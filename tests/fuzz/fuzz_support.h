// What the fuzzers of readers share: input as a file, and what a reader may do with it.
#ifndef DPE_TESTS_FUZZ_FUZZ_SUPPORT_H_
#define DPE_TESTS_FUZZ_FUZZ_SUPPORT_H_

#include <cstddef>
#include <cstdint>
#include <string>

#include "dpe/engine/scene.h"
#include "dpe/estimation/capture.h"

namespace dpe::test {

// Ends the program in the way that libFuzzer takes for a finding.
[[noreturn]] void FailFuzzing(const std::string& message);

inline void Require(bool holds, const char* what) {
  if (!holds) FailFuzzing(what);
}

std::string TextOf(const std::uint8_t* bytes, std::size_t size);

// A file in memory, for readers that take a path.
class MemoryFile {
 public:
  MemoryFile();
  ~MemoryFile();
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;

  void Write(const std::string& content);
  const std::string& path() const { return path_; }

 private:
  int descriptor_;
  std::string path_;
};

// Bad input is a SceneError that says something. Any other exception is a finding.
// @return  whether the input was accepted
template <typename Action>
bool IsAccepted(const Action& action) {
  try {
    action();
    return true;
  } catch (const SceneError& error) {
    Require(error.what()[0] != '\0', "an error without a message");
    return false;
  }
}

// Two cloths of 3 x 3 vertices.
const Scene& FuzzScene();

// What every accepted capture is: points that exist, with numbers that are finite. Then
// goes on with it as an estimation does, to observations of FuzzScene.
void CheckCapture(const Capture& capture, const CaptureOptions& options);

// Reads the bytes with options that accept little, then with ones that accept much.
// Formats are recognised by content; those that are of another one are left to its
// fuzzer.
// @param format  as Capture::format
// @return        for LLVMFuzzerTestOneInput
int FuzzCapture(const std::string& format, const std::uint8_t* bytes, std::size_t size);

}  // namespace dpe::test

#endif  // DPE_TESTS_FUZZ_FUZZ_SUPPORT_H_
