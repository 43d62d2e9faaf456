#include "linear/kept_factor.h"

#include "linear/vectorize.h"

namespace dpe {
namespace {

DPE_VECTORIZE
void ToSingle(const double* __restrict in, size_t size, float* __restrict out) {
  for (size_t i = 0; i < size; ++i) out[i] = static_cast<float>(in[i]);
}

}  // namespace

void KeptFactor::Clear() {
  lower_.clear();
  upper_.clear();
}

void KeptFactor::Store(const std::shared_ptr<const SupernodalStructure>& structure,
                       const SupernodalFactor& factor) {
  structure_ = structure;
  const size_t size = structure->num_values();
  lower_.resize(size);
  ToSingle(factor.lower, size, lower_.data());
  upper_.resize(factor.upper == factor.lower ? 0 : size);
  if (!upper_.empty()) ToSingle(factor.upper, size, upper_.data());
}

SingleFactor KeptFactor::factor() const {
  SingleFactor factor;
  factor.num_supernodes = structure_->num_supernodes;
  factor.first_column = structure_->first_column.data();
  factor.row_start = structure_->row_start.data();
  factor.row_indices = structure_->rows.data();
  factor.value_start = structure_->value_start.data();
  factor.lower = lower_.data();
  factor.upper = upper_.empty() ? lower_.data() : upper_.data();
  return factor;
}

}  // namespace dpe
