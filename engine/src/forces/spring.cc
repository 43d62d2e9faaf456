#include "forces/spring.h"

#include <algorithm>
#include <cmath>

#include "linear/vectorize.h"

namespace dpe {
namespace {

// The quantities of the header's equations, of one spring. Without a direction du, a
// and dT are zero, and without velocity all that beta multiplies; they are then unset.
template <bool kDirection, bool kVelocity>
struct Spring {
  DPE_ALWAYS_INLINE Spring(const SpringLaw::Batch& batch, int lane, double beta_in)
      : k(batch.constants[0].at[lane]), beta(beta_in) {
    const Vec3 d = batch.q[0].Get(lane);
    const double length = std::sqrt(Dot(d, d));
    inverse_length = 1.0 / length;
    u = inverse_length * d;
    tension = length - batch.constants[1].at[lane];
    whole_tension = tension;
    if constexpr (kVelocity) {
      w = batch.u.Get(lane);
      rate = Dot(u, w);
      tension += beta * rate;
      whole_tension = tension;
    }
    if constexpr (kDirection) {
      const Vec3 dd = batch.dq[0].Get(lane);
      a = Dot(u, dd);
      du = inverse_length * (dd - a * u);
      whole_tension += a;
      if constexpr (kVelocity) {
        dw = batch.du.Get(lane);
        drate = Dot(du, w) + Dot(u, dw);
        whole_tension += beta * drate;
      }
    }
  }

  // phi / -k.
  DPE_ALWAYS_INLINE Vec3 Value() const {
    if constexpr (kDirection) return whole_tension * u + tension * du;
    return whole_tension * u;
  }

  // dphi/dd / -k as gamma I + u b^T + du e^T.
  DPE_ALWAYS_INLINE void ExpandPosition(double* gamma, Vec3* b, Vec3* e) const {
    const double stress = tension * inverse_length;
    *gamma = whole_tension * inverse_length;
    if constexpr (kDirection) *gamma -= stress * a * inverse_length;
    *e = (1.0 - stress) * u;
    *b = (1.0 - *gamma) * u;
    if constexpr (kDirection) *b = *b + (1.0 - stress) * du;
    if constexpr (kVelocity) {
      const Vec3 uw = inverse_length * (w - rate * u);  // U w
      *e = *e + beta * uw;
      *b = *b + beta * uw;
      if constexpr (kDirection) {  // V w + U dw
        *b = *b + (beta * inverse_length) * (dw - a * uw - drate * u - rate * du);
      }
    }
  }

  // dphi/dw / -k as u b^T + du e^T; `plain` is the weight of dg/dw.
  DPE_ALWAYS_INLINE void ExpandVelocity(double plain, Vec3* b, Vec3* e) const {
    *e = beta * u;
    *b = plain * *e;
    if constexpr (kDirection) *b = *b + beta * du;
  }

  double k, beta;
  double inverse_length;
  Vec3 u;
  double tension, whole_tension;  // T, T + dT
  Vec3 w, dw;
  double rate, drate;  // c, dc
  Vec3 du;
  double a;
};

DPE_VECTORIZE
void ValueLoop(const SpringLaw::Batch& __restrict batch, LoopFlags flags, double beta,
               VectorLanes* __restrict phi) {
  WithFlags(flags, [&](auto direction, auto velocity) DPE_INLINE_LAMBDA {
    for (int i = 0; i < kBatch; ++i) {
      const Spring<direction, velocity> spring(batch, i, beta);
      phi->Set(i, -spring.k * spring.Value());
    }
  });
}

DPE_VECTORIZE
void MatrixLoop(const SpringLaw::Batch& __restrict batch, LoopFlags flags, double beta,
                JacobianFactors factors, MatrixLanes* __restrict out) {
  WithFlags(flags, [&](auto direction, auto velocity) DPE_INLINE_LAMBDA {
    for (int i = 0; i < kBatch; ++i) {
      const Spring<direction, velocity> spring(batch, i, beta);
      double gamma;
      Vec3 b, e;
      spring.ExpandPosition(&gamma, &b, &e);
      const double cx = -spring.k * factors.cx;
      b = cx * b;
      e = cx * e;
      if constexpr (velocity) {
        Vec3 bv, ev;
        spring.ExpandVelocity(factors.plain, &bv, &ev);
        const double cv = -spring.k * factors.cv;
        b = b + cv * bv;
        e = e + cv * ev;
      }
      Mat3 matrix = AddDiagonal(Outer(spring.u, b), cx * gamma);
      if constexpr (direction) matrix = matrix + Outer(spring.du, e);
      out->Set(i, matrix);
    }
  });
}

DPE_VECTORIZE
void AdjointLoop(const SpringLaw::Batch& __restrict batch, LoopFlags flags, double beta,
                 double plain, AdjointLanes<1>* __restrict out) {
  WithFlags(flags, [&](auto direction, auto velocity) DPE_INLINE_LAMBDA {
    for (int i = 0; i < kBatch; ++i) {
      const Spring<direction, velocity> spring(batch, i, beta);
      const Vec3 s = -spring.k * batch.s.Get(i);
      const double us = Dot(spring.u, s);
      double gamma;
      Vec3 b, e;
      spring.ExpandPosition(&gamma, &b, &e);
      Vec3 q = gamma * s + us * b;
      if constexpr (direction) q = q + Dot(spring.du, s) * e;
      out->q[0].Set(i, q);
      if constexpr (velocity) {
        spring.ExpandVelocity(plain, &b, &e);
        Vec3 u = us * b;
        if constexpr (direction) u = u + Dot(spring.du, s) * e;
        out->u.Set(i, u);
      }
    }
  });
}

// dphi/dk, and with velocities dphi/d(damping).
DPE_VECTORIZE
void ParameterLoop(const SpringLaw::Batch& __restrict batch, LoopFlags flags,
                   double beta, VectorLanes* __restrict out) {
  WithFlags(flags, [&](auto direction, auto velocity) DPE_INLINE_LAMBDA {
    for (int i = 0; i < kBatch; ++i) {
      const Spring<direction, velocity> spring(batch, i, beta);
      out[0].Set(i, -1.0 * spring.Value());
      if constexpr (velocity) {
        Vec3 per_beta = spring.rate * spring.u;
        if constexpr (direction) {
          per_beta = per_beta + spring.drate * spring.u + spring.rate * spring.du;
        }
        out[1].Set(i, -0.5 * spring.k * per_beta);
      }
    }
  });
}

}  // namespace

SpringLaw::SpringLaw(const ClothObject& object, const ObjectParameters* parameters)
    : parameters_(parameters) {
  const Eigen::VectorXd rest_lengths = RestLengths(object);
  for (int s = 0; s < object.num_springs(); ++s) {
    const auto [a, b] = object.springs[s];
    if (object.is_fixed[a] && object.is_fixed[b]) continue;
    elements_.push_back({a, b});
    springs_.push_back(s);
    rest_lengths_.push_back(rest_lengths[s]);
  }
  PadToBatches(&springs_);
  PadToBatches(&rest_lengths_);
}

std::string SpringLaw::UndefinedReason(const double* x) const {
  for (size_t e = 0; e < elements_.size(); ++e) {
    const auto [a, b] = elements_[e];
    if (!std::equal(x + 3 * a, x + 3 * a + 3, x + 3 * b)) continue;
    return "the ends of spring " + std::to_string(springs_[e]) + ", vertices " +
           std::to_string(a) + " and " + std::to_string(b) +
           ", are in the same place, so that its force has no direction";
  }
  return {};
}

void SpringLaw::Values(const Batch& batch, LoopFlags flags, VectorLanes* phi) const {
  ValueLoop(batch, flags, Beta(), phi);
}

void SpringLaw::Matrices(const Batch& batch, LoopFlags flags, JacobianFactors factors,
                         MatrixLanes* matrices) const {
  MatrixLoop(batch, flags, Beta(), factors, matrices);
}

void SpringLaw::Adjoints(const Batch& batch, LoopFlags flags, VelocityPart part,
                         AdjointLanes<1>* out) const {
  AdjointLoop(batch, flags, Beta(), PlainWeight(part), out);
}

void SpringLaw::Parameters(const Batch& batch, LoopFlags flags,
                           VectorLanes* out) const {
  ParameterLoop(batch, flags, Beta(), out);
}

}  // namespace dpe
