// The program runs itself: how it is told to be the process of one job.
//
//   PROGRAM --internal_job DIR ID RESULT_FILE
#ifndef DPE_TOOLS_EXPERIMENTS_EXECUTORS_INTERNAL_H_
#define DPE_TOOLS_EXPERIMENTS_EXECUTORS_INTERNAL_H_

namespace dpe::experiments {

bool IsInternalCommand(int argc, char** argv);

// @return the exit code of the process
int RunInternalCommand(int argc, char** argv);

}  // namespace dpe::experiments

#endif  // DPE_TOOLS_EXPERIMENTS_EXECUTORS_INTERNAL_H_
