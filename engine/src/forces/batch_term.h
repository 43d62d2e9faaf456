// Assembly over elements, many at once: what element_term.h does, for laws whose speed
// matters. A batch of elements is gathered into arrays (element_batch.h), the law's
// loops compute on these, and the results are added where they belong.
//
// A law provides, with the meaning that they have in element_term.h,
//   kVertices, kCoords, kPosition, kVelocity, kForce, IsSymmetric(),
// and
//   using Batch = ElementBatch<kCoords, number of constants>;
//   const std::vector<std::array<int, kVertices>>& elements() const;
//   void GatherConstants(int first, Batch*) const;  // of elements first, first + 1,
//   ... bool UsesVelocity() const;     // false: g(q, u) does not depend on u, at the
//                                  // current parameters
//   void Values(const Batch&, LoopFlags, VectorLanes* phi) const;
//   // The block of vertices i and j of cx dphi/dx + cv dphi/dv is
//   // kForce[i] * kMatrixSign[j] * matrices[kMatrixOf[j]].
//   kMatrices, kMatrixOf[kVertices], kMatrixSign[kVertices];
//   void Matrices(const Batch&, LoopFlags, const JacobianFactors&, MatrixLanes*) const;
//   void Adjoints(const Batch&, LoopFlags, VelocityPart, AdjointLanes<kCoords>*) const;
//   // out[p] = dphi/dp for p < kParameters, of which those with kIsShared belong to no
//   // element in particular. The first does not depend on velocities unless phi does;
//   // the others are wanted only with LoopFlags::velocity.
//   kParameters, kParameterKind[kParameters], kIsShared[kParameters];
//   int ParameterElement(int p, int e) const;
//   void Parameters(const Batch&, LoopFlags, VectorLanes* out) const;
//   std::string UndefinedReason(const double* x) const;  // see force_term.h
#ifndef DPE_ENGINE_FORCES_BATCH_TERM_H_
#define DPE_ENGINE_FORCES_BATCH_TERM_H_

#include <algorithm>
#include <array>
#include <string>
#include <utility>
#include <vector>

#include "forces/element_batch.h"
#include "forces/force_term.h"
#include "forces/lane_scatter.h"

namespace dpe {

template <class Law>
class BatchTerm final : public ForceTerm {
 public:
  static constexpr int kVertices = Law::kVertices;
  static constexpr int kCoords = Law::kCoords;
  using Batch = typename Law::Batch;

  explicit BatchTerm(Law law) : law_(std::move(law)) {
    for (const auto& vertices : law_.elements()) {
      std::array<int, kVertices> rows;
      for (int j = 0; j < kVertices; ++j) rows[j] = 3 * vertices[j];
      rows_.push_back(rows);
    }
    PadToBatches(&rows_);
  }

  int num_elements() const { return static_cast<int>(law_.elements().size()); }

  void AppendCouplings(std::vector<std::pair<int, int>>* pairs) const override {
    for (const auto& vertices : law_.elements()) {
      for (int i = 0; i < kVertices; ++i) {
        for (int j = 0; j < i; ++j) pairs->emplace_back(vertices[i], vertices[j]);
      }
    }
  }

  void BindPattern(const BlockPattern& pattern,
                   const std::vector<int>& node_of_vertex) override {
    slots_.clear();
    for (const auto& vertices : law_.elements()) {
      for (int j = 0; j < kVertices; ++j) {
        for (int i = 0; i < kVertices; ++i) {
          slots_.push_back(
              pattern.Find(node_of_vertex[vertices[i]], node_of_vertex[vertices[j]]));
        }
      }
    }
  }

  void AddForce(const ForceState& state, double* force) const override {
    Batch batch;
    VectorLanes phi;
    const LoopFlags flags = FlagsOf(state);
    for (int first = 0; first < num_elements(); first += kBatch) {
      Gather(state, first, flags, &batch);
      law_.Values(batch, flags, &phi);
      const int count = CountFrom(first);
      for (int i = 0; i < count; ++i) {
        const Vec3 value = phi.Get(i);
        for (int j = 0; j < kVertices; ++j) {
          AddVec3(Law::kForce[j], value, force + rows_[first + i][j]);
        }
      }
    }
  }

  void AddJacobian(const ForceState& state, double cx, double cv, VelocityPart part,
                   double* values) const override {
    Batch batch;
    MatrixLanes matrices[Law::kMatrices];
    const LoopFlags flags = FlagsOf(state);
    const JacobianFactors factors{cx, cv, PlainWeight(part)};
    const BlockSlot* slot = slots_.data();
    for (int first = 0; first < num_elements(); first += kBatch) {
      Gather(state, first, flags, &batch);
      law_.Matrices(batch, flags, factors, matrices);
      const int count = CountFrom(first);
      for (int i = 0; i < count; ++i) {
        for (int j = 0; j < kVertices; ++j, slot += kVertices) {
          double factors_of_rows[kVertices];
          for (int r = 0; r < kVertices; ++r) {
            factors_of_rows[r] = Law::kForce[r] * Law::kMatrixSign[j];
          }
          AddLaneBlocks<kVertices>(matrices[Law::kMatrixOf[j]], i, factors_of_rows,
                                   slot, values);
        }
      }
    }
  }

  void AddAdjoint(const ForceState& state, const double* lambda, double c,
                  VelocityPart part, double* gx, double* gv,
                  ParameterSink* sink) const override {
    Batch batch;
    AdjointLanes<kCoords> out;
    LoopFlags flags = FlagsOf(state);
    // Without a direction dphi/du is its plain part alone.
    const bool has_velocity_part = gv != nullptr && flags.velocity &&
                                   (flags.direction || part == VelocityPart::kWhole);
    const bool has_parameters = sink != nullptr && WantsAny(*sink, &flags);
    for (int first = 0; first < num_elements(); first += kBatch) {
      Gather(state, first, flags, &batch);
      GatherAdjoint(lambda, c, first, &batch);
      law_.Adjoints(batch, flags, part, &out);
      if (has_parameters) ReportAll(first, batch, flags, sink);
      const int count = CountFrom(first);
      for (int i = 0; i < count; ++i) {
        const auto& rows = rows_[first + i];
        for (int m = 0; m < kCoords; ++m) {
          for (int j = 0; j < kVertices; ++j) {
            if (Law::kPosition[m][j] == 0.0) continue;
            AddVec3(Law::kPosition[m][j], out.q[m].Get(i), gx + rows[j]);
          }
        }
        if (!has_velocity_part) continue;
        for (int j = 0; j < kVertices; ++j) {
          AddVec3(Law::kVelocity[j], out.u.Get(i), gv + rows[j]);
        }
      }
    }
  }

  void VisitParameters(const ForceState& state, ParameterSink* sink) const override {
    LoopFlags flags = FlagsOf(state);
    if (!WantsAny(*sink, &flags)) return;
    Batch batch;
    for (int first = 0; first < num_elements(); first += kBatch) {
      Gather(state, first, flags, &batch);
      if (sink->adjoint() != nullptr) {
        GatherAdjoint(sink->adjoint(), sink->scale(), first, &batch);
      }
      ReportAll(first, batch, flags, sink);
    }
  }

  std::string UndefinedReason(const double* x) const override {
    return law_.UndefinedReason(x);
  }

  bool IsSymmetric() const override { return law_.IsSymmetric(); }

 private:
  LoopFlags FlagsOf(const ForceState& state) const {
    return {state.dx != nullptr, law_.UsesVelocity()};
  }
  int CountFrom(int first) const { return std::min(kBatch, num_elements() - first); }

  void Gather(const ForceState& state, int first, LoopFlags flags, Batch* batch) const {
    law_.GatherConstants(first, batch);
    const auto* rows = rows_.data() + first;
    WithFlags(flags, [&](auto direction, auto velocity) DPE_INLINE_LAMBDA {
      for (int i = 0; i < kBatch; ++i) {
        if (state.meanwhile != nullptr) state.meanwhile->Advance();
        for (int m = 0; m < kCoords; ++m) {
          batch->q[m].Set(i, WeightedSum(Law::kPosition[m], state.x, rows[i]));
          if constexpr (!direction) continue;
          batch->dq[m].Set(i, WeightedSum(Law::kPosition[m], state.dx, rows[i]));
        }
        if constexpr (!velocity) continue;
        batch->u.Set(i, WeightedSum(Law::kVelocity, state.v, rows[i]));
        if constexpr (!direction) continue;
        batch->du.Set(i, WeightedSum(Law::kVelocity, state.dv, rows[i]));
      }
    });
  }

  void GatherAdjoint(const double* lambda, double c, int first, Batch* batch) const {
    for (int i = 0; i < kBatch; ++i) {
      batch->s.Set(i, c * WeightedSum(Law::kForce, lambda, rows_[first + i]));
    }
  }

  // Also sets flags->velocity where a parameter needs it.
  static bool WantsAny(const ParameterSink& sink, LoopFlags* flags) {
    bool wants_any = false;
    for (int p = 0; p < Law::kParameters; ++p) {
      const bool wants = sink.Wants(Law::kParameterKind[p]);
      wants_any |= wants;
      flags->velocity |= wants && p > 0;
    }
    return wants_any;
  }

  void ReportAll(int first, const Batch& batch, LoopFlags flags,
                 ParameterSink* sink) const {
    VectorLanes out[Law::kParameters];
    law_.Parameters(batch, flags, out);
    for (int p = 0; p < Law::kParameters; ++p) {
      if (sink->Wants(Law::kParameterKind[p])) Report(p, first, batch, out[p], sink);
    }
  }

  void Report(int p, int first, const Batch& batch, const VectorLanes& derivative,
              ParameterSink* sink) const {
    const int count = CountFrom(first);
    if (sink->adjoint() != nullptr) {
      double sum = 0.0;
      for (int i = 0; i < count; ++i) {
        const double value = Dot(batch.s.Get(i), derivative.Get(i));
        sum += value;
        if (!Law::kIsShared[p]) {
          sink->AddToGradient(Law::kParameterKind[p],
                              law_.ParameterElement(p, first + i), value);
        }
      }
      if (Law::kIsShared[p]) {
        sink->AddToGradient(Law::kParameterKind[p], law_.ParameterElement(p, 0), sum);
      }
      return;
    }
    for (int i = 0; i < count; ++i) {
      const Vec3 d = derivative.Get(i);
      sink->Add(Law::kParameterKind[p], law_.ParameterElement(p, first + i),
                {d.x, d.y, d.z}, law_.elements()[first + i].data(), Law::kForce,
                kVertices);
    }
  }

  Law law_;
  std::vector<std::array<int, kVertices>> rows_;  // 3 * vertex; whole batches
  std::vector<BlockSlot> slots_;                  // by element, column, row
};

}  // namespace dpe

#endif  // DPE_ENGINE_FORCES_BATCH_TERM_H_
