// libFuzzer's entry: `call_order_fuzzer -max_total_time=60 [CORPUS]`.
#include <cstdio>
#include <cstdlib>

#include "fuzz/call_order.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  static const dpe::test::CallOrderFiles files = [] {
    char folder[] = "/tmp/dpe_call_order_XXXXXX";
    if (mkdtemp(folder) == nullptr) std::abort();
    return dpe::test::MakeCallOrderFiles(folder);
  }();
  const std::string failure = dpe::test::RunCallOrder(files, bytes, size);
  if (!failure.empty()) {
    std::fprintf(stderr, "%s\n", failure.c_str());
    std::abort();
  }
  return 0;
}
