#include "linear/prolongation.h"

#include <algorithm>
#include <cmath>

#include "linear/vectorize.h"

namespace dpe {
namespace {

constexpr int kPasses = 3;        // of pairwise matching: up to 8 nodes per aggregate
constexpr float kOmega = 0.9f;   // of the prolongation's smoothing
constexpr float kLeastStrength = 1e-6f;  // of the largest
constexpr float kStrong = 0.25f;
constexpr int kBlockStride = 12;  // of the row of A P at hand, with room to spare

typedef float Float4 __attribute__((vector_size(16), aligned(4), may_alias));

inline const Float4& At(const float* in) {
  return *reinterpret_cast<const Float4*>(in);
}
inline Float4& At(float* in) { return *reinterpret_cast<Float4*>(in); }

inline float Coupling(const float* block) {
  return std::max(0.0f, -(block[0] + block[4] + block[8]));
}

// How strongly blocks couple, whatever their sign. The least that counts is a little
// more than nothing: a coupling that vanishes today may not do so tomorrow.
std::vector<float> Strengths(const BlockRows& fine) {
  std::vector<float> strengths(fine.num_blocks());
  float largest = 0.0f;
  for (int i = 0; i < fine.num_nodes(); ++i) {
    for (int k = fine.starts()[i]; k < fine.starts()[i + 1]; ++k) {
      const float* block = fine.block(k);
      float sum = 0.0f;
      for (int c = 0; c < 9; ++c) sum += block[c] * block[c];
      strengths[k] = std::sqrt(sum);
      if (k != fine.diagonal()[i]) largest = std::max(largest, strengths[k]);
    }
  }
  const float least = largest > 0.0f ? kLeastStrength * largest : 1.0f;
  for (float& strength : strengths) strength = std::max(strength, least);
  return strengths;
}

// The blocks that interpolation follows: the diagonal ones, and those that are not much
// weaker than the strongest of their row or of their column. The others would widen
// the coarse matrix more than they help.
std::vector<bool> StrongCouplings(const BlockRows& fine,
                                  const std::vector<float>& strengths) {
  std::vector<float> strongest(fine.num_nodes(), 0.0f);
  for (int i = 0; i < fine.num_nodes(); ++i) {
    for (int k = fine.starts()[i]; k < fine.starts()[i + 1]; ++k) {
      if (k != fine.diagonal()[i]) strongest[i] = std::max(strongest[i], strengths[k]);
    }
  }
  std::vector<bool> strong(fine.num_blocks());
  for (int i = 0; i < fine.num_nodes(); ++i) {
    for (int k = fine.starts()[i]; k < fine.starts()[i + 1]; ++k) {
      const float least = std::min(strongest[i], strongest[fine.columns()[k]]);
      strong[k] = k == fine.diagonal()[i] || strengths[k] >= kStrong * least;
    }
  }
  return strong;
}

struct Sparsity {
  const int* starts;
  const int* columns;
};

// coarse += P^T A P, row by row of A.
DPE_VECTORIZE
void AddCoarse(Sparsity a, const float* a_values, int num_nodes, Sparsity p,
               const float* weights, const int* product_starts,
               const std::uint16_t* product_slots, const int* coarse_slots, float* row,
               float* coarse) {
  for (int i = 0; i < num_nodes; ++i) {
    const int width = product_starts[i + 1] - product_starts[i];
    for (int c = 0; c < width * kBlockStride; ++c) row[c] = 0.0f;
    for (int k = a.starts[i]; k < a.starts[i + 1]; ++k) {
      const float* block = a_values + 9 * static_cast<size_t>(k);
      const Float4 head = At(block), middle = At(block + 4);
      const float tail = block[8];
      const int j = a.columns[k];
      for (int e = p.starts[j]; e < p.starts[j + 1]; ++e) {
        float* out = row + kBlockStride * *product_slots++;
        At(out) += head * weights[e];
        At(out + 4) += middle * weights[e];
        out[8] += tail * weights[e];
      }
    }
    for (int e = p.starts[i]; e < p.starts[i + 1]; ++e) {
      for (int s = 0; s < width; ++s) {
        float* out = coarse + 9 * static_cast<size_t>(*coarse_slots++);
        const float* in = row + kBlockStride * s;
        At(out) += At(in) * weights[e];
        At(out + 4) += At(in + 4) * weights[e];
        out[8] += in[8] * weights[e];
      }
    }
  }
}

DPE_VECTORIZE
void AddRestricted(Sparsity p, int num_nodes, const float* weights, const float* fine,
                   float* coarse) {
  for (int i = 0; i < num_nodes; ++i, fine += 3) {
    const float x = fine[0], y = fine[1], z = fine[2];
    for (int e = p.starts[i]; e < p.starts[i + 1]; ++e) {
      float* out = coarse + 3 * p.columns[e];
      out[0] += weights[e] * x;
      out[1] += weights[e] * y;
      out[2] += weights[e] * z;
    }
  }
}

DPE_VECTORIZE
void AddInterpolated(Sparsity p, int num_nodes, const float* weights,
                     const float* coarse, float* fine) {
  for (int i = 0; i < num_nodes; ++i, fine += 3) {
    float x = fine[0], y = fine[1], z = fine[2];
    for (int e = p.starts[i]; e < p.starts[i + 1]; ++e) {
      const float* in = coarse + 3 * p.columns[e];
      x += weights[e] * in[0];
      y += weights[e] * in[1];
      z += weights[e] * in[2];
    }
    fine[0] = x;
    fine[1] = y;
    fine[2] = z;
  }
}

// Sorted, each once.
void SortUnique(std::vector<int>* list) {
  std::sort(list->begin(), list->end());
  list->erase(std::unique(list->begin(), list->end()), list->end());
}

int PlaceIn(const std::vector<int>& columns, int first, int last, int column) {
  return static_cast<int>(
      std::lower_bound(columns.begin() + first, columns.begin() + last, column) -
      columns.begin());
}

}  // namespace

Prolongation::Prolongation(const BlockRows& fine) {
  const std::vector<float> strengths = Strengths(fine);
  const Aggregates aggregates =
      Aggregate(fine.starts(), fine.columns(), strengths, kPasses);
  num_coarse_ = aggregates.count;
  FindEntries(fine, aggregates, StrongCouplings(fine, strengths));
  FindProducts(fine);
}

void Prolongation::FindEntries(const BlockRows& fine, const Aggregates& aggregates,
                               const std::vector<bool>& strong) {
  starts_.push_back(0);
  std::vector<int> row;
  for (int i = 0; i < fine.num_nodes(); ++i) {
    row.clear();
    for (int k = fine.starts()[i]; k < fine.starts()[i + 1]; ++k) {
      if (strong[k]) row.push_back(aggregates.of_node[fine.columns()[k]]);
    }
    SortUnique(&row);
    columns_.insert(columns_.end(), row.begin(), row.end());
    starts_.push_back(static_cast<int>(columns_.size()));
    for (int k = fine.starts()[i]; k < fine.starts()[i + 1]; ++k) {
      const int g = aggregates.of_node[fine.columns()[k]];
      weight_of_block_.push_back(
          strong[k] ? PlaceIn(columns_, starts_[i], starts_[i + 1], g) : -1);
    }
  }
  weights_.resize(columns_.size());
}

void Prolongation::FindProducts(const BlockRows& fine) {
  // The pattern of A P, by rows.
  product_starts_.push_back(0);
  std::vector<int> row;
  int max_width = 0;
  for (int i = 0; i < fine.num_nodes(); ++i) {
    row.clear();
    for (int k = fine.starts()[i]; k < fine.starts()[i + 1]; ++k) {
      const int j = fine.columns()[k];
      row.insert(row.end(), columns_.begin() + starts_[j],
                 columns_.begin() + starts_[j + 1]);
    }
    SortUnique(&row);
    product_columns_.insert(product_columns_.end(), row.begin(), row.end());
    product_starts_.push_back(static_cast<int>(product_columns_.size()));
    max_width = std::max(max_width, static_cast<int>(row.size()));
    for (int k = fine.starts()[i]; k < fine.starts()[i + 1]; ++k) {
      const int j = fine.columns()[k];
      for (int e = starts_[j]; e < starts_[j + 1]; ++e) {
        product_slots_.push_back(static_cast<std::uint16_t>(
            PlaceIn(row, 0, static_cast<int>(row.size()), columns_[e])));
      }
    }
  }
  product_row_.resize(static_cast<size_t>(kBlockStride) * max_width);
  // The pattern of P^T A P.
  std::vector<std::vector<int>> coarse_rows(num_coarse_);
  for (int i = 0; i < fine.num_nodes(); ++i) {
    for (int e = starts_[i]; e < starts_[i + 1]; ++e) {
      std::vector<int>& coarse_row = coarse_rows[columns_[e]];
      coarse_row.insert(coarse_row.end(), product_columns_.begin() + product_starts_[i],
                        product_columns_.begin() + product_starts_[i + 1]);
    }
  }
  coarse_starts_.push_back(0);
  for (std::vector<int>& coarse_row : coarse_rows) {
    SortUnique(&coarse_row);
    coarse_columns_.insert(coarse_columns_.end(), coarse_row.begin(), coarse_row.end());
    coarse_starts_.push_back(static_cast<int>(coarse_columns_.size()));
  }
  for (int i = 0; i < fine.num_nodes(); ++i) {
    for (int e = starts_[i]; e < starts_[i + 1]; ++e) {
      const int g = columns_[e];
      for (int s = product_starts_[i]; s < product_starts_[i + 1]; ++s) {
        coarse_slots_.push_back(PlaceIn(coarse_columns_, coarse_starts_[g],
                                        coarse_starts_[g + 1], product_columns_[s]));
      }
    }
  }
}

BlockRows Prolongation::MakeCoarse() const {
  return BlockRows(coarse_starts_, coarse_columns_);
}

void Prolongation::UpdateWeights(const BlockRows& fine) {
  std::fill(weights_.begin(), weights_.end(), 0.0f);
  for (int i = 0; i < fine.num_nodes(); ++i) {
    const int own = fine.diagonal()[i];
    float sum = 0.0f;
    for (int k = fine.starts()[i]; k < fine.starts()[i + 1]; ++k) {
      if (k == own || weight_of_block_[k] < 0) continue;
      const float coupling = Coupling(fine.block(k));
      weights_[weight_of_block_[k]] += coupling;
      sum += coupling;
    }
    const float* block = fine.block(own);
    const float scale = std::max(sum, block[0] + block[4] + block[8]);
    const float omega = scale > 0.0f ? kOmega / scale : 0.0f;
    for (int e = starts_[i]; e < starts_[i + 1]; ++e) weights_[e] *= omega;
    weights_[weight_of_block_[own]] += 1.0f - omega * sum;
  }
}

void Prolongation::Update(const BlockRows& fine, BlockRows* coarse) {
  UpdateWeights(fine);
  coarse->SetZero();
  AddCoarse({fine.starts().data(), fine.columns().data()}, fine.values(),
            fine.num_nodes(), {starts_.data(), columns_.data()}, weights_.data(),
            product_starts_.data(), product_slots_.data(), coarse_slots_.data(),
            product_row_.data(), coarse->values());
}

void Prolongation::Restrict(const float* fine, float* coarse) const {
  std::fill(coarse, coarse + 3 * static_cast<size_t>(num_coarse_), 0.0f);
  AddRestricted({starts_.data(), columns_.data()}, num_fine(), weights_.data(), fine,
                coarse);
}

void Prolongation::AddProlonged(const float* coarse, float* fine) const {
  AddInterpolated({starts_.data(), columns_.data()}, num_fine(), weights_.data(),
                  coarse, fine);
}

}  // namespace dpe
