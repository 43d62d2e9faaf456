// Calls of the C interface in any order, with handles in any state, as bytes say; and
// what has to hold whatever they say.
#ifndef DPE_TESTS_UNITY_PLUGIN_CALL_ORDER_H_
#define DPE_TESTS_UNITY_PLUGIN_CALL_ORDER_H_

#include <cstddef>
#include <cstdint>
#include <string>

namespace dpe::test {

struct CallOrderFiles {
  std::string scene;      // a scene file of one small cloth
  std::string recording;  // of its motion
  std::string folder;     // to write to
};

// Writes them into a folder.
CallOrderFiles MakeCallOrderFiles(const std::string& folder);

// Takes the bytes for calls and their arguments and makes them. What has to hold:
//
// - every call returns one of the status codes, and never DPE_ERROR_INTERNAL;
// - it returns DPE_ERROR_HANDLE exactly if the handle is not a live one of its kind;
// - nothing is written behind the end of a buffer;
// - after dpe_shutdown there are no handles left.
//
// @return  what did not hold; empty: all did
std::string RunCallOrder(const CallOrderFiles& files, const std::uint8_t* bytes,
                         std::size_t size);

// How many different calls there are.
int NumCalls();

}  // namespace dpe::test

#endif  // DPE_TESTS_UNITY_PLUGIN_CALL_ORDER_H_
