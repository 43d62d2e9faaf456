// A kind of job for testing executors, and a cluster before a long campaign: it does
// what it is told, in this order.
//
//   count_file  append a line with the job's id to this file (so that runs can be
//               counted)
//   sleep       wait so many seconds
//   value       report its square as "square"
//   action      "none", "throw", "segfault", "kill", "abort", "loop" (for ever),
//               "exit" (code 7 without a result)
#ifndef DPE_TOOLS_EXPERIMENTS_SELFTEST_H_
#define DPE_TOOLS_EXPERIMENTS_SELFTEST_H_

#include "experiments/experiment.h"

namespace dpe::experiments {

JobKind SelfTestKind();

}  // namespace dpe::experiments

#endif  // DPE_TOOLS_EXPERIMENTS_SELFTEST_H_
