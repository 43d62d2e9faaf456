// How long a step of symplectic Euler may be.
#ifndef DPE_ENGINE_STABLE_STEP_H_
#define DPE_ENGINE_STABLE_STEP_H_

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
// and |x_a - x_b|^2 <= 2 (|x_a|^2 + |x_b|^2), or |x_a|^2 where b is fixed,
//   w^2 <= max over vertices a of (1/m_a) sum over its springs of (2 or 1) k,
// and a collider adds its stiffness, a triangle in the wind at most
//   alpha_a <- alpha_a + (C/3) A |n|^2 / m_a   (law "authored"; without |n|^2 else).
// The condition then holds for each vertex by itself. It is sufficient, not necessary:
// on the legacy cloths the true limit is about 1.8 times as long. It is that of springs
// that are not compressed, and of triangles that have not grown.
double StableStep(const Scene& scene);

}  // namespace dpe

#endif  // DPE_ENGINE_STABLE_STEP_H_
