"""Differentiable cloth: simulate it, differentiate the simulation, recover its parameters.

    import dpe
    scene = dpe.Scene.preset("corners", rows=12, cols=12)
    scene.settings = "nL"                       # every spring's stiffness is unknown
    motion = dpe.simulate(scene).positions      # m, (frames, vertices, 3)
    found = dpe.estimate(scene, motion)
    found.scene.stiffness                       # N/m, one per spring

SI units everywhere, y is up. Arrays of states have the shape (frames, vertices, 3).
"""

import os as _os

# What Ceres would log to stderr is in the results' messages; glog reads this when it is
# loaded.
_quiet = "GLOG_minloglevel" not in _os.environ
if _quiet:
    _os.environ["GLOG_minloglevel"] = "3"
try:
    from dpe._core import (
        BlockUncertainty,
        Cloth,
        Collider,
        Estimate,
        EstimatedBlock,
        InverseDynamics,
        Iteration,
        Motion,
        Observations,
        ParameterBlock,
        ResidualProblem,
        Rollout,
        Scene,
        SceneError,
        SceneWarning,
        SimulationError,
        Simulator,
        State,
        Trajectory,
        TrajectoryCost,
        Uncertainty,
        UndeterminedDirection,
        check_cost,
        gradient,
        inverse_dynamics,
        jacobian,
        jvp,
        marker_positions,
        position_costs,
        simulate,
    )
finally:
    if _quiet:
        del _os.environ["GLOG_minloglevel"]

from dpe._estimate import estimate

__all__ = sorted(name for name in globals() if not name.startswith("_"))
