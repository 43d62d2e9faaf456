#include "linear/prolongation.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "linear/float4.h"
#include "linear/vectorize.h"

namespace dpe {
namespace {

constexpr int kPasses = 3;      // of pairwise matching: up to 8 nodes per aggregate
constexpr float kOmega = 0.9f;  // of the prolongation's smoothing
constexpr float kLeastStrength = 1e-6f;  // of the largest
constexpr float kStrong = 0.25f;
constexpr int kBlockStride = 12;  // of the row of A P at hand, with room to spare

inline float Coupling(const float* block) {
  return std::max(0.0f, -(block[0] + block[4] + block[8]));
}

// How strongly blocks couple, whatever their sign. The least that counts is a little
// more than nothing: a coupling that vanishes today may not do so tomorrow.
std::vector<float> Strengths(const SingleRows& fine) {
  std::vector<float> strengths(fine.num_blocks());
  float largest = 0.0f;
  for (int i = 0; i < fine.num_nodes(); ++i) {
    for (int k = fine.starts()[i]; k < fine.starts()[i + 1]; ++k) {
      const float* block = fine.block(i, k);
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
std::vector<char> StrongCouplings(const SingleRows& fine,
                                  const std::vector<float>& strengths) {
  std::vector<float> strongest(fine.num_nodes(), 0.0f);
  for (int i = 0; i < fine.num_nodes(); ++i) {
    for (int k = fine.starts()[i]; k < fine.starts()[i + 1]; ++k) {
      if (k != fine.diagonal()[i]) strongest[i] = std::max(strongest[i], strengths[k]);
    }
  }
  std::vector<char> strong(fine.num_blocks());
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

// Adds the products of blocks [first, last) of a row of A with the rows of P that they
// meet to the row of A P. Returns the slots that follow.
inline const std::uint16_t* AddProducts(const SingleRows::Rows& a, int first, int last,
                                        const Sparsity& p, const float* weights,
                                        const std::uint16_t* slots, float* row) {
  for (int k = first; k < last; ++k) {
    const float* block = a.values + 9 * static_cast<size_t>(k);
    const Float4 head = LoadFour(block), middle = LoadFour(block + 4);
    const float tail = block[8];
    const int j = a.columns[k];
    for (int e = p.starts[j]; e < p.starts[j + 1]; ++e) {
      float* out = row + kBlockStride * *slots++;
      AddFour(head * weights[e], out);
      AddFour(middle * weights[e], out + 4);
      out[8] += tail * weights[e];
    }
  }
  return slots;
}

// coarse += P^T A P, row by row of A.
DPE_VECTORIZE
void AddCoarse(SingleRows::Rows a, Sparsity p, const float* weights,
               const int* product_starts, const std::uint16_t* product_slots,
               const int* coarse_slots, float* row, float* coarse) {
  const int diagonal = a.lower_starts[a.num_nodes];
  for (int i = 0; i < a.num_nodes; ++i) {
    const int width = product_starts[i + 1] - product_starts[i];
    for (int c = 0; c < width * kBlockStride; ++c) row[c] = 0.0f;
    product_slots = AddProducts(a, a.lower_starts[i], a.lower_starts[i + 1], p, weights,
                                product_slots, row);
    product_slots =
        AddProducts(a, diagonal + i, diagonal + i + 1, p, weights, product_slots, row);
    product_slots = AddProducts(a, a.upper_starts[i], a.upper_starts[i + 1], p, weights,
                                product_slots, row);
    for (int e = p.starts[i]; e < p.starts[i + 1]; ++e) {
      for (int s = 0; s < width; ++s) {
        float* out = coarse + 9 * static_cast<size_t>(*coarse_slots++);
        const float* in = row + kBlockStride * s;
        AddFour(LoadFour(in) * weights[e], out);
        AddFour(LoadFour(in + 4) * weights[e], out + 4);
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

// Numbers the columns of one row at a time in the order they come up.
class RowNumbering {
 public:
  explicit RowNumbering(int num_columns) : row_(num_columns, -1), place_(num_columns) {}

  // Starts row `row`; rows must differ.
  void Start(int row) {
    current_ = row;
    columns_.clear();
  }
  // The place of `column` in the row, which is given to it at its first mention.
  int Place(int column) {
    if (row_[column] != current_) {
      row_[column] = current_;
      place_[column] = static_cast<int>(columns_.size());
      columns_.push_back(column);
    }
    return place_[column];
  }
  // Sorts the columns mentioned so far.
  void Sort() {
    std::sort(columns_.begin(), columns_.end());
    for (size_t k = 0; k < columns_.size(); ++k) {
      place_[columns_[k]] = static_cast<int>(k);
    }
  }
  const std::vector<int>& columns() const { return columns_; }

 private:
  int current_ = -1;
  std::vector<int> row_, place_, columns_;
};

void Append(const std::vector<int>& row, std::vector<int>* columns,
            std::vector<int>* starts) {
  columns->insert(columns->end(), row.begin(), row.end());
  starts->push_back(static_cast<int>(columns->size()));
}

}  // namespace

Prolongation::Prolongation(const SingleRows& fine, SingleRows* coarse) {
  const std::vector<float> strengths = Strengths(fine);
  const Aggregates aggregates =
      Aggregate(fine.starts(), fine.columns(), strengths, kPasses);
  num_coarse_ = aggregates.count;
  FindEntries(fine, aggregates, StrongCouplings(fine, strengths));
  FindProducts(fine);
  FindCoarse(coarse);
}

void Prolongation::FindEntries(const SingleRows& fine, const Aggregates& aggregates,
                               const std::vector<char>& strong) {
  starts_.push_back(0);
  weight_of_block_.reserve(fine.num_blocks());
  RowNumbering row(num_coarse_);
  for (int i = 0; i < fine.num_nodes(); ++i) {
    row.Start(i);
    for (int k = fine.starts()[i]; k < fine.starts()[i + 1]; ++k) {
      const int g = aggregates.of_node[fine.columns()[k]];
      weight_of_block_.push_back(strong[k] ? starts_[i] + row.Place(g) : -1);
    }
    Append(row.columns(), &columns_, &starts_);
  }
  weights_.resize(columns_.size());
}

void Prolongation::FindProducts(const SingleRows& fine) {
  product_starts_.push_back(0);
  RowNumbering row(num_coarse_);
  size_t max_width = 0;
  for (int i = 0; i < fine.num_nodes(); ++i) {
    row.Start(i);
    for (int k = fine.starts()[i]; k < fine.starts()[i + 1]; ++k) {
      const int j = fine.columns()[k];
      for (int e = starts_[j]; e < starts_[j + 1]; ++e) {
        product_slots_.push_back(static_cast<std::uint16_t>(row.Place(columns_[e])));
      }
    }
    Append(row.columns(), &product_columns_, &product_starts_);
    max_width = std::max(max_width, row.columns().size());
  }
  product_row_.resize(kBlockStride * max_width);
}

void Prolongation::FindCoarse(SingleRows* coarse) {
  // The rows of P^T: entries e of P by their column, and which row each is in.
  std::vector<int> row_of_entry(columns_.size()), first(num_coarse_ + 1, 0);
  for (int i = 0; i < num_fine(); ++i) {
    for (int e = starts_[i]; e < starts_[i + 1]; ++e) {
      row_of_entry[e] = i;
      ++first[columns_[e] + 1];
    }
  }
  std::partial_sum(first.begin(), first.end(), first.begin());
  std::vector<int> entries(columns_.size()), next = first;
  for (size_t e = 0; e < columns_.size(); ++e) {
    entries[next[columns_[e]]++] = static_cast<int>(e);
  }
  // Where the products of each entry begin in coarse_slots_.
  std::vector<size_t> slots(columns_.size() + 1, 0);
  const auto width = [&](int i) { return product_starts_[i + 1] - product_starts_[i]; };
  for (size_t e = 0; e < columns_.size(); ++e) {
    slots[e + 1] = slots[e] + width(row_of_entry[e]);
  }
  // Row by row of the coarse matrix: its columns, then where each product goes.
  coarse_slots_.resize(slots.back());
  std::vector<int> coarse_starts = {0}, coarse_columns;
  RowNumbering row(num_coarse_);
  for (int g = 0; g < num_coarse_; ++g) {
    const auto for_each_product = [&](const auto& visit) {
      for (int k = first[g]; k < first[g + 1]; ++k) {
        const int i = row_of_entry[entries[k]];
        for (int s = 0; s < width(i); ++s) {
          visit(product_columns_[product_starts_[i] + s],
                &coarse_slots_[slots[entries[k]] + s]);
        }
      }
    };
    row.Start(g);
    for_each_product([&](int column, int* /*slot*/) { row.Place(column); });
    row.Sort();
    for_each_product(
        [&](int column, int* slot) { *slot = coarse_starts[g] + row.Place(column); });
    Append(row.columns(), &coarse_columns, &coarse_starts);
  }
  *coarse = SingleRows(std::move(coarse_starts), std::move(coarse_columns));
  std::vector<int> places;
  for (int g = 0; g < num_coarse_; ++g) {
    for (int k = coarse->starts()[g]; k < coarse->starts()[g + 1]; ++k) {
      places.push_back(coarse->place(g, k));
    }
  }
  for (int& slot : coarse_slots_) slot = places[slot];
}

void Prolongation::UpdateWeights(const SingleRows& fine) {
  std::fill(weights_.begin(), weights_.end(), 0.0f);
  for (int i = 0; i < fine.num_nodes(); ++i) {
    const int own = fine.diagonal()[i];
    float sum = 0.0f;
    for (int k = fine.starts()[i]; k < fine.starts()[i + 1]; ++k) {
      if (k == own || weight_of_block_[k] < 0) continue;
      const float coupling = Coupling(fine.block(i, k));
      weights_[weight_of_block_[k]] += coupling;
      sum += coupling;
    }
    const float* block = fine.block(i, own);
    const float scale = std::max(sum, block[0] + block[4] + block[8]);
    const float omega = scale > 0.0f ? kOmega / scale : 0.0f;
    for (int e = starts_[i]; e < starts_[i + 1]; ++e) weights_[e] *= omega;
    weights_[weight_of_block_[own]] += 1.0f - omega * sum;
  }
}

void Prolongation::Update(const SingleRows& fine, SingleRows* coarse) {
  UpdateWeights(fine);
  coarse->SetZero();
  AddCoarse(fine.rows(), {starts_.data(), columns_.data()}, weights_.data(),
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
