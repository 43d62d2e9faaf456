#include "forces/spring.h"

#include <cmath>

namespace dpe {

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

}  // namespace dpe
