#include "factorization_watch.h"

#include <cholmod.h>

namespace dpe::bench {
namespace {

FactorizationWatch* active_watch = nullptr;

}  // namespace

FactorizationWatch::FactorizationWatch(int keep) : keep_(keep) { active_watch = this; }

FactorizationWatch::~FactorizationWatch() { active_watch = nullptr; }

FactorizationWatch* FactorizationWatch::Active() { return active_watch; }

void FactorizationWatch::See(const void* matrix) {
  if (count_++ != keep_) return;
  const auto* sparse = static_cast<const cholmod_sparse*>(matrix);
  const int* starts = static_cast<const int*>(sparse->p);
  const int* rows = static_cast<const int*>(sparse->i);
  const double* values = static_cast<const double*>(sparse->x);
  const int num_nonzeros = starts[sparse->ncol];
  matrix_.column_starts.assign(starts, starts + sparse->ncol + 1);
  matrix_.row_indices.assign(rows, rows + num_nonzeros);
  matrix_.values.assign(values, values + num_nonzeros);
}

}  // namespace dpe::bench

// The linker sends calls of cholmod_factorize here (--wrap, see CMakeLists.txt).
extern "C" {

int __real_cholmod_factorize(cholmod_sparse* matrix, cholmod_factor* factor,
                             cholmod_common* common);

int __wrap_cholmod_factorize(cholmod_sparse* matrix, cholmod_factor* factor,
                             cholmod_common* common) {
  dpe::bench::FactorizationWatch* watch = dpe::bench::FactorizationWatch::Active();
  if (watch != nullptr) watch->See(matrix);
  return __real_cholmod_factorize(matrix, factor, common);
}

}  // extern "C"
