// A least-squares problem rotated into as few residuals as it has parameters.
//
// At a point with residuals r (m of them) and Jacobian J (m x n), an optimiser sees
// only the model 1/2 |r + J d|^2. With the QR factorisation of both side by side,
//
//   [J r] = Q [R z; 0 t],   R: n x n,  z: n,  t: a number,
//   |r + J d|^2 = |z + R d|^2 + t^2      for every d,
//
// so the n + 1 residuals (z, t) with Jacobian (R; 0) have the same cost, the same
// gradient J^T r = R^T z and the same J^T J = R^T R, and with them every step of
// Levenberg-Marquardt is the same to rounding. J^T J itself is never formed: the
// condition number is not squared. What it saves: an optimiser that factorises
// [J; damping] for every trial step, as Ceres's DENSE_QR does, pays 2 m n^2 operations
// for each; here they are paid once per Jacobian (tall_qr.h) and a trial step costs
// 10/3 n^3. And J is read in place, in pieces, where Ceres keeps three copies of it.
//
// The cost stays exact, whether a Jacobian is asked for or not: t^2 is what |z|^2
// leaves of twice the full problem's cost, and an evaluation without Jacobian is (0,
// sqrt(2 cost)). With loss functions, r and J are what Ceres corrects them to (Triggs
// et al., Bundle adjustment, 2000, section 4.3); then |r|^2 is at most twice the cost
// as long as the losses are concave, as robust ones are.
//
// Where residuals read different parameter blocks (those of several segments, each with
// an initial state of its own), this is done for each group of rows that read the same
// ones (problem_rows.h) by itself: n is then the number of columns of the group, and
// the reduced problem has one residual block per group and keeps the zeros of J between
// them. A group with no more rows than columns stays as it is.
//
// A residual by itself means nothing: Q changes from point to point.
#ifndef DPE_ESTIMATION_REDUCED_PROBLEM_H_
#define DPE_ESTIMATION_REDUCED_PROBLEM_H_

#include <ceres/ceres.h>

#include <functional>
#include <memory>
#include <set>

#include "dpe/engine/timings.h"

namespace dpe {

// The problem above for all residual blocks of `full`, over the same memory of those
// parameter blocks that are not constant, with their bounds and manifolds. It takes
// `full` as it stands now. Evaluating or solving it moves the parameters of `full`. Do
// not use Ceres's check_gradients with it.
//
// @param full         must outlive the result; its costs are called from several
//                     threads, but never from two at once
// @param callback     that of `full`, or null if it has none
// @param num_threads  to factorise with; the result does not depend on it
// @param timings      if not null, receives the time of the reduction
// @param interrupted  polled between pieces of the reduction, if set, from any thread
//                     but from one at a time; true makes the evaluation fail
// @param relative     parameter blocks of logarithms whose steps are to be relative
//                     changes (relative_step_manifold.h), unless they have a manifold
// @return             null if there is nothing to gain: no more residuals than
//                     parameters
std::unique_ptr<ceres::Problem> NewReducedProblem(
    ceres::Problem* full, ceres::EvaluationCallback* callback, int num_threads,
    Timings* timings, std::function<bool()> interrupted = nullptr,
    const std::set<const double*>& relative = {});

}  // namespace dpe

#endif  // DPE_ESTIMATION_REDUCED_PROBLEM_H_
