#include "cholesky_floor.h"

#include <cstring>
#include <limits>
#include <new>

#include "resource_usage.h"

// CHOLMOD's OpenMP runtime, if it has one: its parallel regions, one per supernode,
// cost more than they bring.
extern "C" __attribute__((weak)) void omp_set_max_active_levels(int levels);

namespace dpe::bench {

CholeskyFloor::CholeskyFloor(const SymmetricMatrix& matrix) : matrix_(matrix) {
  if (omp_set_max_active_levels != nullptr) omp_set_max_active_levels(0);
  cholmod_start(&common_);
  common_.print = 0;
  common_.supernodal = CHOLMOD_SUPERNODAL;
  common_.nmethods = 1;
  common_.method[0].ordering = CHOLMOD_NESDIS;
  common_.final_ll = 1;
  std::memset(&sparse_, 0, sizeof(sparse_));
  sparse_.nrow = sparse_.ncol = matrix_.num_rows();
  sparse_.nzmax = matrix_.values.size();
  sparse_.p = matrix_.column_starts.data();
  sparse_.i = matrix_.row_indices.data();
  sparse_.x = matrix_.values.data();
  sparse_.stype = -1;
  sparse_.itype = CHOLMOD_INT;
  sparse_.xtype = CHOLMOD_REAL;
  sparse_.dtype = CHOLMOD_DOUBLE;
  sparse_.sorted = sparse_.packed = 1;
  factor_ = cholmod_analyze(&sparse_, &common_);
  right_ = cholmod_ones(sparse_.nrow, 1, CHOLMOD_REAL, &common_);
  if (factor_ == nullptr || right_ == nullptr) throw std::bad_alloc();
}

CholeskyFloor::~CholeskyFloor() {
  for (cholmod_dense** dense : {&right_, &solution_, &work_y_, &work_e_}) {
    cholmod_free_dense(dense, &common_);
  }
  cholmod_free_factor(&factor_, &common_);
  cholmod_finish(&common_);
}

bool CholeskyFloor::FactorizeAndSolve() {
  cholmod_factorize(&sparse_, factor_, &common_);
  if (common_.status != CHOLMOD_OK) return false;
  return cholmod_solve2(CHOLMOD_A, factor_, right_, nullptr, &solution_, nullptr,
                        &work_y_, &work_e_, &common_) != 0;
}

double CholeskyFloor::Milliseconds(double seconds) {
  // The first one allocates the factor.
  if (!FactorizeAndSolve()) return std::numeric_limits<double>::quiet_NaN();
  const double start = CpuSeconds();
  int count = 0;
  while (count < 2 || CpuSeconds() - start < seconds) {
    FactorizeAndSolve();
    ++count;
  }
  return 1e3 * (CpuSeconds() - start) / count;
}

}  // namespace dpe::bench
