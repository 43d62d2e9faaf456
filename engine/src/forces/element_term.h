// Assembly over elements, written once for all kernels.
//
// A kernel describes one element through reduced coordinates: kCoords position vectors
// q_m = sum_j kPosition[m][j] x_j, one velocity u = sum_j kVelocity[j] v_j, and one
// force vector g(q, u) that acts on vertex j with weight kForce[j]. With
//   phi = g + dg/dq dq + dg/du du
// every block of the object's Jacobian is
//   dphi_i/dx_j = kForce[i] sum_m kPosition[m][j] dphi/dq_m,
//   dphi_i/dv_j = kForce[i] kVelocity[j] dphi/du.
//
// A kernel provides
//   static constexpr int kVertices, kCoords;
//   static constexpr double kPosition[kCoords][kVertices], kVelocity[kVertices],
//                           kForce[kVertices];
//   std::vector<std::array<int, kVertices>> elements;
//   void Value(int e, const ElementInput<kCoords>&, Eigen::Vector3d* phi) const;
//   void Expand(int e, const ElementInput<kCoords>&, Expansion<kCoords>*) const;
//   void Parameters(int e, const ElementInput<kCoords>&, Report) const;
//   bool IsSymmetric() const;
#ifndef DPE_ENGINE_FORCES_ELEMENT_TERM_H_
#define DPE_ENGINE_FORCES_ELEMENT_TERM_H_

#include <array>
#include <utility>
#include <vector>

#include "forces/force_term.h"

namespace dpe {

template <int kCoords>
struct ElementInput {
  std::array<Eigen::Vector3d, kCoords> q;  // m
  Eigen::Vector3d u;                       // m/s
  std::array<Eigen::Vector3d, kCoords> dq;
  Eigen::Vector3d du;
  bool has_direction;  // false: dq and du are not set and count as zero
};

// Derivatives of phi; plain_du is dg/du.
template <int kCoords>
struct Expansion {
  std::array<Eigen::Matrix3d, kCoords> dq;
  Eigen::Matrix3d du;
  Eigen::Matrix3d plain_du;
};

template <class Kernel>
class ElementTerm final : public ForceTerm {
 public:
  static constexpr int kVertices = Kernel::kVertices;
  static constexpr int kCoords = Kernel::kCoords;

  explicit ElementTerm(Kernel kernel) : kernel_(std::move(kernel)) {}

  int num_elements() const { return static_cast<int>(kernel_.elements.size()); }
  const Kernel& kernel() const { return kernel_; }
  // Its elements must stay.
  Kernel* mutable_kernel() { return &kernel_; }

  void AppendCouplings(std::vector<std::pair<int, int>>* pairs) const override {
    for (const auto& vertices : kernel_.elements) {
      for (int i = 0; i < kVertices; ++i) {
        for (int j = 0; j < i; ++j) pairs->emplace_back(vertices[i], vertices[j]);
      }
    }
  }

  void BindPattern(const BlockPattern& pattern,
                   const std::vector<int>& node_of_vertex) override {
    slots_.clear();
    for (const auto& vertices : kernel_.elements) {
      for (int i = 0; i < kVertices; ++i) {
        for (int j = 0; j < kVertices; ++j) {
          slots_.push_back(
              pattern.Find(node_of_vertex[vertices[i]], node_of_vertex[vertices[j]]));
        }
      }
    }
  }

  void AddForce(const ForceState& state, double* force) const override {
    ElementInput<kCoords> input;
    Eigen::Vector3d phi;
    for (int e = 0; e < num_elements(); ++e) {
      Gather(state, e, &input);
      kernel_.Value(e, input, &phi);
      for (int i = 0; i < kVertices; ++i) {
        double* f = force + 3 * kernel_.elements[e][i];
        for (int c = 0; c < 3; ++c) f[c] += Kernel::kForce[i] * phi[c];
      }
    }
  }

  void AddJacobian(const ForceState& state, double cx, double cv, VelocityPart part,
                   double* values) const override {
    ElementInput<kCoords> input;
    Expansion<kCoords> expansion;
    const BlockSlot* slot = slots_.data();
    for (int e = 0; e < num_elements(); ++e) {
      Gather(state, e, &input);
      kernel_.Expand(e, input, &expansion);
      if (part == VelocityPart::kMinusPlain) expansion.du -= expansion.plain_du;
      Eigen::Matrix3d of_vertex[kVertices];
      for (int j = 0; j < kVertices; ++j) {
        of_vertex[j] = cv * Kernel::kVelocity[j] * expansion.du;
        for (int m = 0; m < kCoords; ++m) {
          if (Kernel::kPosition[m][j] == 0.0) continue;
          of_vertex[j] += cx * Kernel::kPosition[m][j] * expansion.dq[m];
        }
      }
      for (int i = 0; i < kVertices; ++i) {
        for (int j = 0; j < kVertices; ++j, ++slot) {
          AddBlock(*slot, Kernel::kForce[i] * of_vertex[j], values);
        }
      }
    }
  }

  void AddAdjoint(const ForceState& state, const double* lambda, double c,
                  VelocityPart part, double* gx, double* gv,
                  ParameterSink* sink) const override {
    if (sink != nullptr) VisitParameters(state, sink);
    ElementInput<kCoords> input;
    Expansion<kCoords> expansion;
    for (int e = 0; e < num_elements(); ++e) {
      const auto& vertices = kernel_.elements[e];
      Eigen::Vector3d s = Eigen::Vector3d::Zero();
      for (int i = 0; i < kVertices; ++i) {
        s += (c * Kernel::kForce[i]) *
             Eigen::Map<const Eigen::Vector3d>(lambda + 3 * vertices[i]);
      }
      Gather(state, e, &input);
      kernel_.Expand(e, input, &expansion);
      if (part == VelocityPart::kMinusPlain) expansion.du -= expansion.plain_du;
      const Eigen::Vector3d su = expansion.du.transpose() * s;
      Eigen::Vector3d sq[kCoords];
      for (int m = 0; m < kCoords; ++m) sq[m] = expansion.dq[m].transpose() * s;
      for (int j = 0; j < kVertices; ++j) {
        Eigen::Map<Eigen::Vector3d> gxj(gx + 3 * vertices[j]);
        for (int m = 0; m < kCoords; ++m) {
          if (Kernel::kPosition[m][j] == 0.0) continue;
          gxj += Kernel::kPosition[m][j] * sq[m];
        }
        if (gv == nullptr) continue;
        Eigen::Map<Eigen::Vector3d> gvj(gv + 3 * vertices[j]);
        gvj += Kernel::kVelocity[j] * su;
      }
    }
  }

  void VisitParameters(const ForceState& state, ParameterSink* sink) const override {
    if (!kernel_.OwnsAny(*sink)) return;
    ElementInput<kCoords> input;
    for (int e = 0; e < num_elements(); ++e) {
      Gather(state, e, &input);
      kernel_.Parameters(
          e, input, [&](ParameterKind kind, int element, const auto& derivative) {
            sink->Add(kind, element, derivative, kernel_.elements[e].data(),
                      Kernel::kForce, kVertices);
          });
    }
  }

  bool IsSymmetric() const override { return kernel_.IsSymmetric(); }

 private:
  void Gather(const ForceState& state, int e, ElementInput<kCoords>* input) const {
    const auto& vertices = kernel_.elements[e];
    Reduce(state.x, vertices, &input->q);
    input->u = ReduceVelocity(state.v, vertices);
    input->has_direction = state.dx != nullptr;
    if (!input->has_direction) return;
    Reduce(state.dx, vertices, &input->dq);
    input->du = ReduceVelocity(state.dv, vertices);
  }

  static void Reduce(const double* x, const std::array<int, kVertices>& vertices,
                     std::array<Eigen::Vector3d, kCoords>* q) {
    for (int m = 0; m < kCoords; ++m) {
      (*q)[m].setZero();
      for (int j = 0; j < kVertices; ++j) {
        if (Kernel::kPosition[m][j] == 0.0) continue;
        (*q)[m] += Kernel::kPosition[m][j] *
                   Eigen::Map<const Eigen::Vector3d>(x + 3 * vertices[j]);
      }
    }
  }

  static Eigen::Vector3d ReduceVelocity(const double* v,
                                        const std::array<int, kVertices>& vertices) {
    Eigen::Vector3d u = Eigen::Vector3d::Zero();
    for (int j = 0; j < kVertices; ++j) {
      u +=
          Kernel::kVelocity[j] * Eigen::Map<const Eigen::Vector3d>(v + 3 * vertices[j]);
    }
    return u;
  }

  Kernel kernel_;
  std::vector<BlockSlot> slots_;
};

}  // namespace dpe

#endif  // DPE_ENGINE_FORCES_ELEMENT_TERM_H_
