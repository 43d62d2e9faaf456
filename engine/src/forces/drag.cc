#include "forces/drag.h"

#include <cfloat>
#include <cmath>

#include "linear/vectorize.h"

namespace dpe {
namespace {

using Air = DragLaw::Air;

constexpr double kThird = 1.0 / 3.0;

// The quantities of the header's equations, of one triangle. Without a direction dn,
// dw, r and dq are zero and unset.
template <bool kDirection>
struct Triangle {
  DPE_ALWAYS_INLINE Triangle(const DragLaw::Batch& batch, int lane, const Air& air)
      : e1(batch.q[0].Get(lane)), e2(batch.q[1].Get(lane)), n(Cross(e1, e2)) {
    w = air.wind - kThird * batch.u.Get(lane);
    // No branches: DBL_MIN is lost in the rounding of any n^2 but that of a collapsed
    // triangle, where it saves the division; `is_open` is then 0, otherwise 1.
    const double n2 = Dot(n, n);
    const double m2 = n2 + DBL_MIN;
    const double is_open = n2 / m2;
    const double inverse_m2 = is_open / m2;
    p = is_open * std::sqrt(m2) * (air.authored + air.unit_normal * inverse_m2);
    t = air.sign * inverse_m2;
    q = Dot(n, w);
    zeta = q;
    if constexpr (kDirection) {
      de1 = batch.dq[0].Get(lane);
      de2 = batch.dq[1].Get(lane);
      dn = Cross(de1, e2) + Cross(e1, de2);
      dw = -kThird * batch.du.Get(lane);
      r = t * Dot(n, dn);
      dq = Dot(dn, w) + Dot(n, dw);
      zeta += dq + r * q;
    }
  }

  DPE_ALWAYS_INLINE Vec3 Value() const {
    if constexpr (kDirection) return p * (zeta * n + q * dn);
    return (p * zeta) * n;
  }

  // dphi/dn / p as zeta I + n b^T + dn g^T.
  DPE_ALWAYS_INLINE void ExpandNormal(const Air& air, Vec3* b, Vec3* g) const {
    *g = w + (t * q) * n;
    *b = *g;
    if constexpr (kDirection) {
      const double ratio = 1.0 - 2.0 * air.sign;  // (s - 2) / s
      *b = *b + (t * (ratio * r * q + dq)) * n + (t * q) * dn + r * w + dw;
    }
  }

  // dphi/dw / p as n b^T + dn n^T; `plain` is the weight of df/dw.
  DPE_ALWAYS_INLINE Vec3 ExpandVelocity(double plain) const {
    if constexpr (kDirection) return (plain + r) * n + dn;
    return plain * n;
  }

  Vec3 e1, e2, n, w;
  double p, t, q, zeta;
  Vec3 de1, de2, dn, dw;
  double r, dq;
};

// A matrix [c]x + n b^T + dn g^T.
struct CrossAndOuter {
  Vec3 c, b, g;
};

// dphi/de1 / -p with `e` = e2, or dphi/de2 / p with `e` = e1.
template <bool kDirection>
DPE_ALWAYS_INLINE CrossAndOuter OfEdge(const Triangle<kDirection>& triangle, Vec3 b,
                                       Vec3 g, const Vec3& e, const Vec3& de) {
  CrossAndOuter out;
  out.c = triangle.zeta * e;
  out.b = Cross(b, e);
  if constexpr (kDirection) {
    out.c = out.c + triangle.q * de;
    out.b = out.b + Cross(g, de);
    out.g = Cross(g, e);
  }
  return out;
}

template <bool kDirection>
DPE_ALWAYS_INLINE Mat3 Dense(const Triangle<kDirection>& triangle, Vec3 c, Vec3 b,
                             Vec3 g) {
  Mat3 m = AddCross(Outer(triangle.n, b), c);
  if constexpr (kDirection) m = m + Outer(triangle.dn, g);
  return m;
}

template <bool kDirection>
DPE_ALWAYS_INLINE Vec3 TransposeTimes(const Triangle<kDirection>& triangle,
                                      const CrossAndOuter& form, Vec3 s) {
  Vec3 out = Cross(s, form.c) + Dot(triangle.n, s) * form.b;
  if constexpr (kDirection) out = out + Dot(triangle.dn, s) * form.g;
  return out;
}

DPE_VECTORIZE
void ValueLoop(const DragLaw::Batch& __restrict batch, LoopFlags flags, Air air,
               VectorLanes* __restrict phi) {
  WithDirection(flags, [&](auto direction) DPE_INLINE_LAMBDA {
    for (int i = 0; i < kBatch; ++i) {
      phi->Set(i, Triangle<direction>(batch, i, air).Value());
    }
  });
}

// With F1 = cx dphi/de1, F2 = cx dphi/de2 and W = cv dphi/du = -(cv / 3) dphi/dw, the
// columns of the vertices are W - F1 - F2, W + F1 and W + F2.
DPE_VECTORIZE
void MatrixLoop(const DragLaw::Batch& __restrict batch, LoopFlags flags, Air air,
                JacobianFactors factors, MatrixLanes* __restrict out) {
  WithDirection(flags, [&](auto direction) DPE_INLINE_LAMBDA {
    for (int i = 0; i < kBatch; ++i) {
      const Triangle<direction> triangle(batch, i, air);
      Vec3 b, g;
      triangle.ExpandNormal(air, &b, &g);
      const auto f1 = OfEdge(triangle, b, g, triangle.e2, triangle.de2);
      const auto f2 = OfEdge(triangle, b, g, triangle.e1, triangle.de1);
      const double cx = factors.cx * triangle.p;
      const double cv = -kThird * factors.cv * triangle.p;
      const Vec3 bw = cv * triangle.ExpandVelocity(factors.plain);
      const Vec3 gw = cv * triangle.n;
      const Vec3 c1 = -cx * f1.c, b1 = -cx * f1.b, g1 = -cx * f1.g;
      const Vec3 c2 = cx * f2.c, b2 = cx * f2.b, g2 = cx * f2.g;
      out[0].Set(i, Dense(triangle, -1.0 * (c1 + c2), bw - (b1 + b2), gw - (g1 + g2)));
      out[1].Set(i, Dense(triangle, c1, bw + b1, gw + g1));
      out[2].Set(i, Dense(triangle, c2, bw + b2, gw + g2));
    }
  });
}

DPE_VECTORIZE
void AdjointLoop(const DragLaw::Batch& __restrict batch, LoopFlags flags, Air air,
                 double plain, AdjointLanes<2>* __restrict out) {
  WithDirection(flags, [&](auto direction) DPE_INLINE_LAMBDA {
    for (int i = 0; i < kBatch; ++i) {
      const Triangle<direction> triangle(batch, i, air);
      const Vec3 s = triangle.p * batch.s.Get(i);
      Vec3 b, g;
      triangle.ExpandNormal(air, &b, &g);
      const auto f1 = OfEdge(triangle, b, g, triangle.e2, triangle.de2);
      const auto f2 = OfEdge(triangle, b, g, triangle.e1, triangle.de1);
      out->q[0].Set(i, -1.0 * TransposeTimes(triangle, f1, s));
      out->q[1].Set(i, TransposeTimes(triangle, f2, s));
      Vec3 u = Dot(triangle.n, s) * triangle.ExpandVelocity(plain);
      if constexpr (direction) u = u + Dot(triangle.dn, s) * triangle.n;
      out->u.Set(i, -kThird * u);
    }
  });
}

// dphi/dC for kappa = 1/6, and dphi/d(wind) for the kappa of the triangle.
DPE_VECTORIZE
void ParameterLoop(const DragLaw::Batch& __restrict batch, LoopFlags flags, Air air,
                   double coefficient, VectorLanes* __restrict out) {
  WithDirection(flags, [&](auto direction) DPE_INLINE_LAMBDA {
    for (int i = 0; i < kBatch; ++i) {
      const Triangle<direction> triangle(batch, i, air);
      out[0].Set(i, triangle.Value());
      const double p = coefficient * triangle.p;
      Mat3 of_wind = Outer(triangle.n, p * triangle.ExpandVelocity(1.0));
      if constexpr (direction) of_wind = of_wind + Outer(p * triangle.dn, triangle.n);
      out[1].Set(i, of_wind.x);
      out[2].Set(i, of_wind.y);
      out[3].Set(i, of_wind.z);
    }
  });
}

}  // namespace

DragLaw::DragLaw(const ClothObject& object, AerodynamicsLaw law,
                 const ObjectParameters* parameters)
    : parameters_(parameters), unit_normal_(law == AerodynamicsLaw::kUnitNormal) {
  for (const auto& t : object.triangles) {
    if (object.is_fixed[t[0]] && object.is_fixed[t[1]] && object.is_fixed[t[2]]) {
      continue;
    }
    elements_.push_back(t);
  }
}

DragLaw::Air DragLaw::AirOf(double coefficient) const {
  const Eigen::Vector3d& wind = parameters_->wind;
  const double kappa = coefficient / 6.0;
  return {unit_normal_ ? 0.0 : kappa,
          unit_normal_ ? kappa : 0.0,
          unit_normal_ ? -1.0 : 1.0,
          {wind.x(), wind.y(), wind.z()}};
}

void DragLaw::Values(const Batch& batch, LoopFlags flags, VectorLanes* phi) const {
  ValueLoop(batch, flags, AirOf(parameters_->drag_coefficient), phi);
}

void DragLaw::Matrices(const Batch& batch, LoopFlags flags, JacobianFactors factors,
                       MatrixLanes* matrices) const {
  MatrixLoop(batch, flags, AirOf(parameters_->drag_coefficient), factors, matrices);
}

void DragLaw::Adjoints(const Batch& batch, LoopFlags flags, VelocityPart part,
                       AdjointLanes<2>* out) const {
  AdjointLoop(batch, flags, AirOf(parameters_->drag_coefficient), PlainWeight(part),
              out);
}

void DragLaw::Parameters(const Batch& batch, LoopFlags flags, VectorLanes* out) const {
  ParameterLoop(batch, flags, AirOf(1.0), parameters_->drag_coefficient, out);
}

}  // namespace dpe
