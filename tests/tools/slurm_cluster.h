// A real Slurm cluster of one machine: munged, slurmctld and slurmd, started and
// stopped by a test, in a folder and on ports of its own. Nothing of an installed
// cluster is used or touched.
#ifndef DPE_TESTS_TOOLS_SLURM_CLUSTER_H_
#define DPE_TESTS_TOOLS_SLURM_CLUSTER_H_

#include <sys/types.h>

#include <string>
#include <vector>

#include "support/temp_dir.h"

namespace dpe::test {

class SlurmCluster {
 public:
  // Why there cannot be one here: not root, or programs that are missing; "" if nothing
  // is in the way.
  static std::string Obstacle();

  // Returns when the node takes jobs. While this object lives, SLURM_CONF is set for
  // the programs that the test starts.
  // @throws std::runtime_error with the daemons' logs if they do not come up
  explicit SlurmCluster(int max_array_size);
  ~SlurmCluster();
  SlurmCluster(const SlurmCluster&) = delete;
  SlurmCluster& operator=(const SlurmCluster&) = delete;

  // What a Slurm command (squeue, scancel, ...) prints.
  std::string Ask(const std::vector<std::string>& command) const;

 private:
  void WriteConfiguration(int max_array_size) const;
  void Start(const std::vector<std::string>& command);
  void WaitForNode() const;
  void Stop();
  std::string Logs() const;

  const TempDir folder_;
  std::vector<pid_t> daemons_;
};

}  // namespace dpe::test

#endif  // DPE_TESTS_TOOLS_SLURM_CLUSTER_H_
