// Ctrl-C asks a program to stop in order; a second one ends it at once.
#ifndef DPE_TOOLS_SUPPORT_INTERRUPT_H_
#define DPE_TOOLS_SUPPORT_INTERRUPT_H_

namespace dpe::tools {

// From now on the first SIGINT or SIGTERM only makes WasInterrupted() true, and the
// second has its usual effect.
void CatchInterrupts();

bool WasInterrupted();

}  // namespace dpe::tools

#endif  // DPE_TOOLS_SUPPORT_INTERRUPT_H_
