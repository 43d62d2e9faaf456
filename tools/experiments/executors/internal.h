// The program runs itself: how it is told to be the process of one job, or to watch one
// as an element of a Slurm array.
//
//   PROGRAM --internal_job DIR ID RESULT_FILE
//   PROGRAM --internal_task DIR TASKS_FILE INDEX TIMEOUT
#ifndef DPE_TOOLS_EXPERIMENTS_EXECUTORS_INTERNAL_H_
#define DPE_TOOLS_EXPERIMENTS_EXECUTORS_INTERNAL_H_

#include <string>

namespace dpe::experiments {

bool IsInternalCommand(int argc, char** argv);

// @return the exit code of the process
// @throws SceneError
int RunInternalCommand(char** argv);

// The absolute path of the program that is running.
// @throws SceneError if it cannot be found out
std::string ProgramPath();

}  // namespace dpe::experiments

#endif  // DPE_TOOLS_EXPERIMENTS_EXECUTORS_INTERNAL_H_
