// Where derivatives with respect to parameters go: either contracted with an adjoint
// vector into a gradient, or listed as entries of a sparse matrix. Force terms report
// each derivative once and do not know which of the two is being built.
#ifndef DPE_ENGINE_FORCES_PARAMETER_SINK_H_
#define DPE_ENGINE_FORCES_PARAMETER_SINK_H_

#include <Eigen/Core>
#include <array>
#include <vector>

#include "dpe/engine/parameters.h"

namespace dpe {

// For one object: the column of each element of each kind, -1 where the element is not
// a parameter.
class ParameterColumns {
 public:
  static constexpr int kNumKinds = 7;

  // Columns are numbered by the layout's own offsets.
  ParameterColumns(const ParameterLayout& layout, int object);
  ParameterColumns() = default;

  bool Has(ParameterKind kind) const { return !Of(kind).empty(); }
  int Column(ParameterKind kind, int element) const {
    const std::vector<int>& columns = Of(kind);
    return columns.empty() ? -1 : columns[element];
  }
  // All columns that this object's motion depends on, ascending.
  const std::vector<int>& used() const { return used_; }

  // The same map with columns renumbered 0, 1, ... in the order of used().
  ParameterColumns Compressed() const;

 private:
  const std::vector<int>& Of(ParameterKind kind) const {
    return columns_[static_cast<int>(kind)];
  }
  std::array<std::vector<int>, kNumKinds> columns_;
  std::vector<int> used_;
};

// One entry of d(residual)/dp: row 0..3N-1, column by ParameterColumns.
struct ParameterEntry {
  int row;
  int column;
  double value;
};

class ParameterSink {
 public:
  // gradient[column] += scale * lambda^T dphi/dp.
  // @param lambda  3N, zero at fixed vertices
  ParameterSink(const ParameterColumns& columns, double scale, const double* lambda,
                double* gradient)
      : columns_(columns), scale_(scale), lambda_(lambda), gradient_(gradient) {}

  // Appends scale * dphi/dp to `entries`, rows of fixed vertices left out.
  ParameterSink(const ParameterColumns& columns, double scale,
                const std::vector<int>& node_of_vertex,
                std::vector<ParameterEntry>* entries)
      : columns_(columns),
        scale_(scale),
        node_of_vertex_(&node_of_vertex),
        entries_(entries) {}

  bool Wants(ParameterKind kind) const { return columns_.Has(kind); }
  bool Wants(ParameterKind kind, int element) const {
    return columns_.Column(kind, element) >= 0;
  }
  void set_scale(double scale) { scale_ = scale; }
  double scale() const { return scale_; }
  // lambda if a gradient is being built, null if entries are being listed.
  const double* adjoint() const { return lambda_; }

  // For a gradient: adds `value` = scale * lambda^T dphi/dp, contracted by the caller.
  void AddToGradient(ParameterKind kind, int element, double value) {
    const int column = columns_.Column(kind, element);
    if (column >= 0) gradient_[column] += value;
  }

  // The derivative of the force on vertices[j] is weights[j] * d, j < count.
  void Add(ParameterKind kind, int element, const Eigen::Vector3d& d,
           const int* vertices, const double* weights, int count) {
    const int column = columns_.Column(kind, element);
    if (column < 0) return;
    for (int j = 0; j < count; ++j) {
      const double w = scale_ * weights[j];
      if (gradient_ != nullptr) {
        const double* l = lambda_ + 3 * vertices[j];
        gradient_[column] += w * (l[0] * d[0] + l[1] * d[1] + l[2] * d[2]);
      } else if ((*node_of_vertex_)[vertices[j]] >= 0) {
        for (int c = 0; c < 3; ++c) {
          entries_->push_back({3 * vertices[j] + c, column, w * d[c]});
        }
      }
    }
  }

 private:
  const ParameterColumns& columns_;
  double scale_;
  const double* lambda_ = nullptr;
  double* gradient_ = nullptr;
  const std::vector<int>* node_of_vertex_ = nullptr;
  std::vector<ParameterEntry>* entries_ = nullptr;
};

}  // namespace dpe

#endif  // DPE_ENGINE_FORCES_PARAMETER_SINK_H_
