#include "support/interrupt.h"

#include <csignal>

namespace dpe::tools {
namespace {

volatile std::sig_atomic_t was_interrupted = 0;

void Handle(int signal) {
  was_interrupted = 1;
  std::signal(signal, SIG_DFL);
}

}  // namespace

void CatchInterrupts() {
  std::signal(SIGINT, Handle);
  std::signal(SIGTERM, Handle);
}

bool WasInterrupted() { return was_interrupted != 0; }

}  // namespace dpe::tools
