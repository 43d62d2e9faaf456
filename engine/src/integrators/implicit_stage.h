// One implicit stage: the velocity v that solves
//   r(v) = M v - b - c f(x, v) = 0,  x = x_in + c v,
// for a given momentum b, by Newton's method with a backtracking line search on |r|.
//
// Newton's matrix M - c D - c^2 K is the exact derivative of r, and iteration goes on
// to rounding level, so that the derivative of the converged stage is the implicit
// function theorem's.
//
// Where Newton's method fails from the first guess, r = 0 is solved for growing c, from
// the root b / M at c = 0 to the c that was asked for, in 2, 4, ... pieces, each
// starting from what those before it found (continuation). The stage solved in the end
// is the same, so its derivatives are too.
#ifndef DPE_ENGINE_INTEGRATORS_IMPLICIT_STAGE_H_
#define DPE_ENGINE_INTEGRATORS_IMPLICIT_STAGE_H_

#include <vector>

#include "integrators/integrator.h"

namespace dpe {

class ImplicitStage {
 public:
  explicit ImplicitStage(const SimulatorOptions& options) : options_(options) {}

  // @param x_in, momentum  3N; entries of fixed vertices are not read
  // @param x, v            3N; v holds the first guess at free vertices, and both hold
  //                        the prescribed state at fixed ones; out: the solution
  StepOutcome Solve(ObjectSystem* system, StepSolver* solver, double c,
                    const double* x_in, const double* momentum, double* x, double* v);

 private:
  // residual_ := r(v), x := x_in + c v. Returns |r|; scale_ := that of its largest
  // term.
  double Residual();
  // What rounding of x and v leaves of r: eps |A_ii| (|x_i| / c + |v_i|), since the
  // elements' forces are differences of positions times c^2 K / c; and eps c K (l + r)
  // of a vertex in contact, where the obstacle's K (r - l) is a difference.
  // @param values  of Newton's matrix
  double RoundingLevel(const double* values) const;
  // Moves v along the Newton step in free_, halving it until |r| falls.
  bool LineSearch(double* norm);
  bool NewtonStep();
  // Newton's method from the v at hand, until |r| <= tolerance * scale_.
  StepOutcome Newton(double tolerance);
  bool Continuation(double c, int pieces);

  SimulatorOptions options_;
  ObjectSystem* system_ = nullptr;
  StepSolver* solver_ = nullptr;
  double c_ = 0.0;
  const double* x_in_ = nullptr;
  const double* momentum_ = nullptr;
  double* x_ = nullptr;
  double* v_ = nullptr;
  double scale_ = 0.0;
  double rounding_ = 0.0;
  std::vector<double> residual_, force_, free_, start_, guess_, before_;
};

}  // namespace dpe

#endif  // DPE_ENGINE_INTEGRATORS_IMPLICIT_STAGE_H_
