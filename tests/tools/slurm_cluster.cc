#include "tools/slurm_cluster.h"

#include <arpa/inet.h>
#include <fcntl.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <random>
#include <stdexcept>
#include <thread>

#include "experiments/executors/shell.h"

namespace dpe::test {
namespace {

using experiments::RunCommand;

// Daemons are not in the PATH of every user, and without a configuration none of the
// commands answers.
std::string ProgramPath(const std::string& name) {
  for (const char* folder : {"/usr/sbin/", "/usr/local/sbin/", "/usr/bin/"}) {
    if (access((folder + name).c_str(), X_OK) == 0) return folder + name;
  }
  return "";
}

std::string HostName() {
  char name[256] = {};
  gethostname(name, sizeof(name) - 1);
  const std::string full = name;
  return full.substr(0, full.find('.'));
}

// A port that nobody listens on now.
int FreePort() {
  const int descriptor = socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in address = {};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof(address);
  const bool is_bound =
      bind(descriptor, reinterpret_cast<sockaddr*>(&address), size) == 0 &&
      getsockname(descriptor, reinterpret_cast<sockaddr*>(&address), &size) == 0;
  close(descriptor);
  if (!is_bound) throw std::runtime_error("no free port");
  return ntohs(address.sin_port);
}

std::string KeyBytes() {
  std::mt19937 generator(std::random_device{}());
  std::string key(1024, '\0');
  for (char& byte : key) byte = static_cast<char>(generator());
  return key;
}

}  // namespace

std::string SlurmCluster::Obstacle() {
  if (getuid() != 0) return "a Slurm cluster can be started by root only";
  for (const char* program : {"munged", "slurmctld", "slurmd", "sbatch", "squeue"}) {
    if (ProgramPath(program).empty()) return std::string(program) + " is not installed";
  }
  return "";
}

SlurmCluster::SlurmCluster(int max_array_size) {
  // munged wants its folders to be nobody else's.
  for (const char* name : {"munge", "state", "spool"}) {
    std::filesystem::create_directory(folder_.File(name));
    chmod(folder_.File(name).c_str(), 0700);
  }
  chmod(folder_.path().c_str(), 0755);
  WriteFile(folder_.File("munge/key"), KeyBytes());
  chmod(folder_.File("munge/key").c_str(), 0600);
  WriteConfiguration(max_array_size);
  setenv("SLURM_CONF", folder_.File("slurm.conf").c_str(), 1);
  Start({ProgramPath("munged"), "--foreground", "--force",
         "--socket=" + folder_.File("munge.sock"),
         "--key-file=" + folder_.File("munge/key"),
         "--log-file=" + folder_.File("munge/log"),
         "--pid-file=" + folder_.File("munge/pid"),
         "--seed-file=" + folder_.File("munge/seed")});
  Start({ProgramPath("slurmctld"), "-D", "-f", folder_.File("slurm.conf")});
  Start({ProgramPath("slurmd"), "-D", "-f", folder_.File("slurm.conf"), "-N",
         HostName()});
  try {
    WaitForNode();
  } catch (...) {
    Stop();
    throw;
  }
}

SlurmCluster::~SlurmCluster() { Stop(); }

void SlurmCluster::Stop() {
  // The last started first; slurmd is given time to end its steps.
  while (!daemons_.empty()) {
    const pid_t daemon = daemons_.back();
    daemons_.pop_back();
    kill(daemon, SIGTERM);
    for (int i = 0; i < 100 && waitpid(daemon, nullptr, WNOHANG) == 0; ++i) {
      if (i == 99) {
        kill(daemon, SIGKILL);
        waitpid(daemon, nullptr, 0);
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(100));
    }
  }
  unsetenv("SLURM_CONF");
}

std::string SlurmCluster::Ask(const std::vector<std::string>& command) const {
  const experiments::CommandResult result = RunCommand(command);
  return result.out + result.err;
}

void SlurmCluster::WriteConfiguration(int max_array_size) const {
  const std::string host = HostName();
  WriteFile(folder_.File("slurm.conf"),
            "ClusterName=dpe_test\nSlurmctldHost=" + host +
                "(127.0.0.1)\nSlurmctldPort=" + std::to_string(FreePort()) +
                "\nSlurmdPort=" + std::to_string(FreePort()) +
                "\nAuthType=auth/munge\nAuthInfo=socket=" + folder_.File("munge.sock") +
                "\nCredType=cred/munge\nSlurmUser=root\nSlurmdUser=root\n"
                "StateSaveLocation=" +
                folder_.File("state") + "\nSlurmdSpoolDir=" + folder_.File("spool") +
                "\nSlurmctldPidFile=" + folder_.File("slurmctld.pid") +
                "\nSlurmdPidFile=" + folder_.File("slurmd.pid") +
                "\nSlurmctldLogFile=" + folder_.File("slurmctld.log") +
                "\nSlurmdLogFile=" + folder_.File("slurmd.log") +
                "\nProctrackType=proctrack/linuxproc\nTaskPlugin=task/none\n"
                "SelectType=select/cons_tres\nSelectTypeParameters=CR_Core\n"
                "SwitchType=switch/none\nMpiDefault=none\nReturnToService=2\n"
                "SchedulerParameters=batch_sched_delay=0,sched_interval=2\nKillWait=2\n"
                "MaxArraySize=" +
                std::to_string(max_array_size) + "\nNodeName=" + host +
                " NodeAddr=127.0.0.1 CPUs=2 State=UNKNOWN\n"
                "PartitionName=test Nodes=ALL Default=YES MaxTime=INFINITE State=UP\n");
}

void SlurmCluster::Start(const std::vector<std::string>& command) {
  const std::string log = folder_.File("daemon_" + std::to_string(daemons_.size()));
  std::vector<char*> argv;
  for (const std::string& argument : command) {
    argv.push_back(const_cast<char*>(argument.c_str()));
  }
  argv.push_back(nullptr);
  const pid_t child = fork();
  if (child < 0) throw std::runtime_error("cannot fork");
  if (child == 0) {
    const int output = open(log.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    dup2(output, STDOUT_FILENO);
    dup2(output, STDERR_FILENO);
    execv(argv[0], argv.data());
    _exit(127);
  }
  daemons_.push_back(child);
}

void SlurmCluster::WaitForNode() const {
  for (int i = 0; i < 300; ++i) {
    if (Ask({"sinfo", "--noheader", "--format=%T"}).rfind("idle", 0) == 0) return;
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
  }
  throw std::runtime_error("the Slurm cluster does not come up:\n" + Logs());
}

std::string SlurmCluster::Logs() const {
  std::string text;
  for (const char* name :
       {"daemon_0", "daemon_1", "daemon_2", "slurmctld.log", "slurmd.log"}) {
    if (!std::filesystem::exists(folder_.File(name))) continue;
    text += std::string("--- ") + name + "\n" + ReadFile(folder_.File(name));
  }
  return text;
}

}  // namespace dpe::test
