#ifndef DPE_TESTS_UNITY_PLUGIN_CALL_ORDER_CALLS_H_
#define DPE_TESTS_UNITY_PLUGIN_CALL_ORDER_CALLS_H_

#include <functional>
#include <vector>

#include "fuzz/call_order_player.h"

namespace dpe::test {

using OneCall = std::function<void(CallOrderPlayer*)>;

// Every function of the C interface that has a status, with arguments that the player
// draws.
const std::vector<OneCall>& AllCalls();

std::vector<OneCall> SceneCalls();
std::vector<OneCall> ChangeCalls();
std::vector<OneCall> PlaybackCalls();
std::vector<OneCall> BuilderCalls();
std::vector<OneCall> EstimationCalls();

// A function of one handle: `name` is for messages.
template <class Call>
OneCall OnHandle(const char* name, Kind kind, const Call& call) {
  return [=](CallOrderPlayer* p) {
    const HandleModel handle = *p->Handle(kind);
    p->Check(name, call(p, handle.handle), handle, kind);
  };
}

}  // namespace dpe::test

#endif  // DPE_TESTS_UNITY_PLUGIN_CALL_ORDER_CALLS_H_
