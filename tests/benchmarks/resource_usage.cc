#include "resource_usage.h"

#include <malloc.h>

#include <ctime>
#include <fstream>
#include <string>

namespace dpe::bench {
namespace {

// A line of /proc/self/status, MiB; 0 if there is none of that name.
double StatusMebibytes(const std::string& key) {
  std::ifstream status("/proc/self/status");
  std::string line;
  while (std::getline(status, line)) {
    if (line.rfind(key + ":", 0) == 0) {
      return std::stod(line.substr(key.size() + 1)) / 1024.0;
    }
  }
  return 0.0;
}

}  // namespace

double CpuSeconds() {
  timespec time;
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

MemoryPeak::MemoryPeak() {
  // What an earlier benchmark freed must not serve this one unseen.
  malloc_trim(0);
  std::ofstream("/proc/self/clear_refs") << "5";  // peak := what is resident now
  start_ = StatusMebibytes("VmRSS");
}

double MemoryPeak::Mebibytes() const { return ResidentMebibytes() - start_; }

double MemoryPeak::ResidentMebibytes() const { return StatusMebibytes("VmHWM"); }

}  // namespace dpe::bench
