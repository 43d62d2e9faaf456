#include "reference_kernels.h"

#include <Eigen/Geometry>
#include <cmath>

namespace dpe::test {
namespace {

Eigen::Matrix3d CrossMatrix(const Eigen::Vector3d& a) {
  Eigen::Matrix3d m;
  m << 0.0, -a.z(), a.y(), a.z(), 0.0, -a.x(), -a.y(), a.x(), 0.0;
  return m;
}

}  // namespace

DragKernel::DragKernel(const ClothObject& object, AerodynamicsLaw law,
                       const ObjectParameters* parameters)
    : parameters_(parameters), unit_normal_(law == AerodynamicsLaw::kUnitNormal) {
  for (const auto& t : object.triangles) {
    if (object.is_fixed[t[0]] && object.is_fixed[t[1]] && object.is_fixed[t[2]]) {
      continue;
    }
    elements.push_back(t);
  }
}

void DragKernel::PerCoefficient(const ElementInput<2>& in, Eigen::Vector3d* phi) const {
  const Eigen::Vector3d n = in.q[0].cross(in.q[1]);
  const Eigen::Vector3d w = parameters_->wind - in.u;
  const double m2 = n.squaredNorm();
  if (m2 == 0.0) {  // a collapsed triangle catches no air
    phi->setZero();
    return;
  }
  const double m = std::sqrt(m2);
  const double power = (unit_normal_ ? 1.0 / m : m) / 6.0;
  const double q = n.dot(w);
  *phi = power * q * n;
  if (!in.has_direction) return;
  const double s = unit_normal_ ? -1.0 : 1.0;
  const Eigen::Vector3d dn = in.dq[0].cross(in.q[1]) + in.q[0].cross(in.dq[1]);
  const double r = n.dot(dn);
  const double dq = dn.dot(w) - n.dot(in.du);
  *phi += power * ((s * r * q / m2 + dq) * n + q * dn);
}

void DragKernel::Value(int /*e*/, const ElementInput<2>& in,
                       Eigen::Vector3d* phi) const {
  PerCoefficient(in, phi);
  *phi *= parameters_->drag_coefficient;
}

void DragKernel::Expand(int /*e*/, const ElementInput<2>& in, Expansion<2>* out) const {
  const Eigen::Vector3d n = in.q[0].cross(in.q[1]);
  const Eigen::Vector3d w = parameters_->wind - in.u;
  const double m2 = n.squaredNorm();
  if (m2 == 0.0) {
    out->dq = {Eigen::Matrix3d::Zero(), Eigen::Matrix3d::Zero()};
    out->du.setZero();
    out->plain_du.setZero();
    return;
  }
  const double m = std::sqrt(m2);
  const double s = unit_normal_ ? -1.0 : 1.0;
  const double power =
      parameters_->drag_coefficient * (unit_normal_ ? 1.0 / m : m) / 6.0;
  const double q = n.dot(w);
  const Eigen::Matrix3d identity = Eigen::Matrix3d::Identity();
  const Eigen::Matrix3d nnt = n * n.transpose();
  Eigen::Matrix3d of_n =
      power * ((s * q / m2) * nnt + q * identity + n * w.transpose());
  out->plain_du = -power * nnt;
  out->du = out->plain_du;
  const Eigen::Matrix3d cross1 = CrossMatrix(in.q[0]);
  const Eigen::Matrix3d cross2 = CrossMatrix(in.q[1]);
  if (!in.has_direction) {
    out->dq[0] = -of_n * cross2;
    out->dq[1] = of_n * cross1;
    return;
  }
  const Eigen::Vector3d dw = -in.du;
  const Eigen::Vector3d dn = in.dq[0].cross(in.q[1]) + in.q[0].cross(in.dq[1]);
  const double r = n.dot(dn);
  const double dq = dn.dot(w) + n.dot(dw);
  const Eigen::Matrix3d of_dn = of_n;  // dn enters dF as n enters F
  of_n += power *
          ((s * (s - 2.0) * r * q / (m2 * m2)) * nnt +
           (s / m2) * (q * n * dn.transpose() + r * n * w.transpose() +
                       (q * dn + dq * n) * n.transpose()) +
           dn * w.transpose() + n * dw.transpose() + (dq + s * r * q / m2) * identity);
  out->du -= power * ((s * r / m2) * nnt + dn * n.transpose() + n * dn.transpose());
  out->dq[0] = -of_n * cross2 - of_dn * CrossMatrix(in.dq[1]);
  out->dq[1] = of_n * cross1 + of_dn * CrossMatrix(in.dq[0]);
}

SpringKernel::SpringKernel(const ClothObject& object,
                           const ObjectParameters* parameters)
    : parameters_(parameters) {
  for (int s = 0; s < object.num_springs(); ++s) {
    const auto [a, b] = object.springs[s];
    if (object.is_fixed[a] && object.is_fixed[b]) continue;
    elements.push_back({a, b});
    springs_.push_back(s);
    rest_lengths_.push_back(
        (object.positions.segment<3>(3 * a) - object.positions.segment<3>(3 * b))
            .norm());
  }
}

void SpringKernel::Value(int e, const ElementInput<1>& in, Eigen::Vector3d* phi) const {
  const double k = Stiffness(e);
  const double beta = 0.5 * parameters_->damping;
  const double length = in.q[0].norm();
  const Eigen::Vector3d u = in.q[0] / length;
  const double tension = length - rest_lengths_[e] + beta * u.dot(in.u);
  *phi = -k * tension * u;
  if (!in.has_direction) return;
  const double stretch_rate = u.dot(in.dq[0]);
  const Eigen::Vector3d turn = (in.dq[0] - stretch_rate * u) / length;
  const double tension_rate = stretch_rate + beta * (turn.dot(in.u) + u.dot(in.du));
  *phi -= k * (tension_rate * u + tension * turn);
}

void SpringKernel::Expand(int e, const ElementInput<1>& in, Expansion<1>* out) const {
  const double k = Stiffness(e);
  const double beta = 0.5 * parameters_->damping;
  const double length = in.q[0].norm();
  const Eigen::Vector3d u = in.q[0] / length;
  const Eigen::Vector3d& w = in.u;
  const double tension = length - rest_lengths_[e] + beta * u.dot(w);
  const Eigen::Matrix3d uut = u * u.transpose();
  const Eigen::Matrix3d turn_of_d = (Eigen::Matrix3d::Identity() - uut) / length;
  out->plain_du = (-k * beta) * uut;
  if (!in.has_direction) {
    out->dq[0] =
        -k * (u * (u + beta * (turn_of_d * w)).transpose() + tension * turn_of_d);
    out->du = out->plain_du;
    return;
  }
  const double stretch_rate = u.dot(in.dq[0]);
  const Eigen::Vector3d turn = turn_of_d * in.dq[0];
  const double tension_rate = stretch_rate + beta * (turn.dot(w) + u.dot(in.du));
  const Eigen::Matrix3d u_turn = u * turn.transpose();
  const Eigen::Matrix3d turn_of_d2 =
      -(stretch_rate * turn_of_d + u_turn + u_turn.transpose()) / length;
  out->dq[0] =
      -k * ((u + turn) * (u + beta * (turn_of_d * w)).transpose() +
            tension * (turn_of_d + turn_of_d2) +
            u * (turn + beta * (turn_of_d2 * w + turn_of_d * in.du)).transpose() +
            tension_rate * turn_of_d);
  out->du = out->plain_du - (k * beta) * (u_turn + u_turn.transpose());
}

void SpringKernel::PerStiffness(int e, const ElementInput<1>& in, Eigen::Vector3d* phi,
                                Eigen::Vector3d* per_beta) const {
  const double beta = 0.5 * parameters_->damping;
  const double length = in.q[0].norm();
  const Eigen::Vector3d u = in.q[0] / length;
  const double rate = u.dot(in.u);
  const double tension = length - rest_lengths_[e] + beta * rate;
  *phi = -tension * u;
  *per_beta = -rate * u;
  if (!in.has_direction) return;
  const double stretch_rate = u.dot(in.dq[0]);
  const Eigen::Vector3d turn = (in.dq[0] - stretch_rate * u) / length;
  const double rate_rate = turn.dot(in.u) + u.dot(in.du);
  *phi -= (stretch_rate + beta * rate_rate) * u + tension * turn;
  *per_beta -= rate_rate * u + rate * turn;
}

}  // namespace dpe::test
