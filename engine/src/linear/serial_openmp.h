// Keeps a library that was built with OpenMP from opening parallel regions.
//
// CHOLMOD's supernodal factorisation opens a 4-thread region per supernode, whatever
// the environment asks for. For the matrices of a cloth that costs more than it brings
// (0.37 instead of 0.25 ms at 12 x 12 vertices, far more when other threads are busy),
// and our own threads work on independent pieces instead.
#ifndef DPE_ENGINE_LINEAR_SERIAL_OPENMP_H_
#define DPE_ENGINE_LINEAR_SERIAL_OPENMP_H_

// Resolved at load time if an OpenMP runtime is present.
extern "C" {
__attribute__((weak)) int omp_get_max_active_levels(void);
__attribute__((weak)) void omp_set_max_active_levels(int levels);
}

namespace dpe {

// While it lives, parallel regions opened by this thread run on this thread alone.
class SerialOpenmp {
 public:
  SerialOpenmp() {
    if (omp_get_max_active_levels == nullptr) return;
    levels_ = omp_get_max_active_levels();
    omp_set_max_active_levels(0);
  }
  ~SerialOpenmp() {
    if (omp_get_max_active_levels != nullptr) omp_set_max_active_levels(levels_);
  }
  SerialOpenmp(const SerialOpenmp&) = delete;
  SerialOpenmp& operator=(const SerialOpenmp&) = delete;

 private:
  int levels_ = 1;
};

}  // namespace dpe

#endif  // DPE_ENGINE_LINEAR_SERIAL_OPENMP_H_
