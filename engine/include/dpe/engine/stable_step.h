// How long a step of symplectic Euler may be.
#ifndef DPE_ENGINE_STABLE_STEP_H_
#define DPE_ENGINE_STABLE_STEP_H_

#include "dpe/engine/export.h"
#include "dpe/engine/scene.h"

namespace dpe {

// A step length (s) up to which symplectic Euler is stable on every object of the
// scene; infinite for one without forces that depend on the state.
//
// For a mode of frequency w, damped by the springs (beta w^2) and by what acts on each
// vertex alone (alpha), the step
//   v1 = v0 - h w^2 x0 - h (alpha + beta w^2) v0,   x1 = x0 + h v1
// has the characteristic polynomial z^2 - (2 - h alpha - h (h + beta) w^2) z
// + (1 - h alpha - h beta w^2), whose roots are in the unit circle exactly if
//   2 h alpha + h (h + 2 beta) w^2 <= 4.
// The frequencies are not computed but bounded. From x^T K x = sum k (u (x_a - x_b))^2
// with the springs' directions u, and (u (x_a - x_b))^2 <= 2 (u x_a)^2 + 2 (u x_b)^2,
// or (u x_a)^2 where b is fixed,
//   w^2 <= max over vertices a of (1/m_a) lambda_max(sum over its springs of
//          (2 or 1) k u u^T),
// to which a collider adds its stiffness; and a triangle in the wind adds at most
//   (C/3) A |n|^2 / m_a   (law "authored"; without |n|^2 else)
// to alpha. The condition then holds for each vertex by itself. It is sufficient for
// the cloth as it lies at the start: not where springs later come to lie otherwise, are
// compressed, or triangles have grown. Whoever relies on it leaves some room.
DPE_ENGINE_API double StableStep(const Scene& scene);

}  // namespace dpe

#endif  // DPE_ENGINE_STABLE_STEP_H_
