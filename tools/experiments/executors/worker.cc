#include "experiments/executors/worker.h"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>
#ifdef __linux__
#include <sys/prctl.h>
#endif

#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <new>
#include <sstream>
#include <thread>
#include <vector>

#include "dpe/engine/scene.h"
#include "dpe/engine/scene_io.h"
#include "experiments/campaign.h"
#include "experiments/machine.h"
#include "experiments/record_io.h"

namespace dpe::experiments {
namespace {

constexpr int kCannotStart = 127;

// Runs in the child: only calls that are safe between fork and exec.
[[noreturn]] void Execute(char* const* argv, char* const* environment, const char* dir,
                          const char* log, pid_t parent) {
  setpgid(0, 0);
#ifdef __linux__
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent) _exit(kCannotStart);  // it died before the line above
#else
  (void)parent;
#endif
  const rlimit no_core = {0, 0};
  setrlimit(RLIMIT_CORE, &no_core);
  signal(SIGINT, SIG_DFL);
  signal(SIGTERM, SIG_DFL);
  const int input = open("/dev/null", O_RDONLY);
  const int output = open(log, O_WRONLY | O_CREAT | O_TRUNC, 0666);
  if (input >= 0 && output >= 0 && dup2(input, STDIN_FILENO) >= 0 &&
      dup2(output, STDOUT_FILENO) >= 0 && dup2(output, STDERR_FILENO) >= 0 &&
      chdir(dir) == 0) {
    execve(argv[0], argv, environment);
  }
  _exit(kCannotStart);
}

std::vector<char*> Pointers(const std::vector<std::string>& texts) {
  std::vector<char*> pointers;
  for (const std::string& text : texts) {
    pointers.push_back(const_cast<char*>(text.c_str()));
  }
  pointers.push_back(nullptr);
  return pointers;
}

// The environment with one BLAS thread: jobs run beside each other, and what they
// compute must not depend on how many cores there are.
std::vector<std::string> Environment() {
  std::vector<std::string> result = {"OPENBLAS_NUM_THREADS=1"};
  for (char** entry = environ; *entry != nullptr; ++entry) {
    const std::string text = *entry;
    if (text.rfind("OPENBLAS_NUM_THREADS=", 0) != 0) result.push_back(text);
  }
  return result;
}

std::string SignalName(int signal) {
  switch (signal) {
    case SIGSEGV:
      return "SIGSEGV (segmentation fault)";
    case SIGABRT:
      return "SIGABRT (aborted)";
    case SIGFPE:
      return "SIGFPE (arithmetic error)";
    case SIGILL:
      return "SIGILL (illegal instruction)";
    case SIGBUS:
      return "SIGBUS (bad memory access)";
    case SIGKILL:
      return "SIGKILL (killed from outside, perhaps for want of memory)";
    case SIGTERM:
      return "SIGTERM (ended from outside)";
    default:
      return "signal " + std::to_string(signal);
  }
}

double Seconds(const timeval& time) {
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

Record UsageRecord(double wall_s, const rusage& usage) {
#ifdef __APPLE__
  constexpr double kPerMib = 1024.0 * 1024.0;  // counted in bytes there
#else
  constexpr double kPerMib = 1024.0;
#endif
  Record record;
  record.Set("wall_s", wall_s);
  record.Set("cpu_s", Seconds(usage.ru_utime) + Seconds(usage.ru_stime));
  record.Set("peak_mib", static_cast<double>(usage.ru_maxrss) / kPerMib);
  return record;
}

Record Failed(const std::string& outcome, const std::string& reason) {
  Record record;
  record.Set("outcome", outcome);
  record.Set("reason", reason);
  return record;
}

// What the job wrote, or what became of it.
Record ReadResult(int status, const std::string& path, const std::string& timeout) {
  if (!timeout.empty()) return Failed("timed_out", timeout);
  if (WIFSIGNALED(status)) return Failed("crashed", SignalName(WTERMSIG(status)));
  std::ifstream file(path);
  std::ostringstream text;
  if (file) text << file.rdbuf();
  if (WEXITSTATUS(status) != 0 || text.str().empty()) {
    return Failed("crashed", "it ended with code " +
                                 std::to_string(WEXITSTATUS(status)) +
                                 " without a result");
  }
  return RecordFromJson(text.str(), path);
}

}  // namespace

Worker::Worker(const Job& job, const WorkerSettings& settings, const RowStore& store)
    : job_(job),
      settings_(settings),
      store_(store),
      start_(std::chrono::steady_clock::now()) {
  const std::string id = JobId(job);
  result_path_ = store.dir() + "/rows/." + id + "." + std::to_string(getpid());
  const std::vector<std::string> arguments = {settings.program, "--internal_job",
                                              store.dir(), id, result_path_};
  const std::vector<std::string> environment = Environment();
  const std::vector<char*> argv = Pointers(arguments), envp = Pointers(environment);
  const std::string log = store.LogPath(id);
  const pid_t parent = getpid();
  process_ = fork();
  if (process_ < 0) {
    throw SceneError(std::string("cannot start the process of a job: ") +
                     std::strerror(errno));
  }
  if (process_ == 0) {
    Execute(argv.data(), envp.data(), settings.working_dir.c_str(), log.c_str(),
            parent);
  }
  setpgid(process_, process_);  // whoever of the two comes first
}

Worker::~Worker() {
  if (has_ended_) return;
  kill(-process_, SIGKILL);
  while (waitpid(process_, nullptr, 0) < 0 && errno == EINTR) {
  }
  std::error_code ignored;
  std::filesystem::remove(result_path_, ignored);
}

double Worker::Elapsed() const {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_)
      .count();
}

bool Worker::Poll() {
  if (has_ended_) return true;
  if (!is_over_time_ && settings_.timeout_s > 0.0 && Elapsed() > settings_.timeout_s) {
    is_over_time_ = true;
    kill(-process_, SIGKILL);
  }
  int status = 0;
  rusage usage = {};
  const pid_t ended = wait4(process_, &status, WNOHANG, &usage);
  if (ended != process_) return false;
  has_ended_ = true;
  kill(-process_, SIGKILL);  // what it may have left behind
  const Record measured = UsageRecord(Elapsed(), usage);
  if (!is_over_time_ && WIFSIGNALED(status) &&
      (WTERMSIG(status) == SIGKILL || WTERMSIG(status) == SIGTERM)) {
    std::this_thread::sleep_for(
        std::chrono::duration<double>(settings_.killed_delay_s));
  }
  Finish(status, measured);
  return true;
}

void Worker::Finish(int status, const Record& usage) {
  std::ostringstream timeout;
  if (is_over_time_) timeout << "killed after " << settings_.timeout_s << " s";
  result_ = ReadResult(status, result_path_, timeout.str());
  for (const auto& [key, value] : usage.values()) result_.Set(key, value);
  store_.Write({job_, result_, ThisMachine()});
  std::error_code ignored;
  std::filesystem::remove(result_path_, ignored);
}

int RunJobProcess(const std::string& dir, const std::string& id,
                  const std::string& result_path) {
  Record result;
  try {
    const Job job = ReadJob(dir, id);
    const JobKind* kind = FindJobKind(job.Text("kind", ""));
    if (kind == nullptr) throw SceneError("there is no such kind of job");
    result = kind->run(job);
    result.Set("outcome", "done");
    result.Set("reason", "");
  } catch (const std::bad_alloc&) {
    result = Failed("failed", "not enough memory");
  } catch (const std::exception& error) {
    result = Failed("failed", error.what());
  }
  WriteFileAtomically(result_path, RecordToJson(result));
  return 0;
}

}  // namespace dpe::experiments
