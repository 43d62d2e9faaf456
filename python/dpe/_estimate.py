"""dpe.estimate: what estimate_cloth does, on scenes and arrays."""

from __future__ import annotations

import os
from typing import Any, Callable, Optional, Sequence, Union

from dpe import _core

Path = Union[str, "os.PathLike[str]"]
Scenes = Union[None, _core.Scene, Path, Sequence[Union[_core.Scene, Path]]]


def _as_list(value: Any) -> list:
    if value is None:
        return []
    return list(value) if isinstance(value, (list, tuple)) else [value]


def estimate(
    scene: Scenes = None,
    target: Any = None,
    *,
    settings: Optional[str] = None,
    estimate: Union[str, Sequence[str], None] = None,
    frames: Optional[int] = None,
    validate_frames: int = 0,
    init: Any = "auto",
    init_perturbation: float = 0.0,
    solver: str = "auto",
    jacobian: str = "auto",
    horizon: str = "auto",
    uncertainty: str = "auto",
    sigma: float = 0.0,
    loss: str = "none",
    loss_scale: float = 0.0,
    prior: str = "",
    smoothness: str = "",
    max_iterations: Optional[int] = None,
    max_seconds: Optional[float] = None,
    noise_sigma: float = 0.0,
    seed: int = 0,
    threads: int = 1,
    memory_limit: float = 2048,
    checkpoint: Optional[Path] = None,
    resume: Optional[Path] = None,
    target_scale: float = 0.0,
    target_up: str = "y",
    target_rate: float = 0.0,
    target_origin: str = "auto",
    target_nan_is_missing: bool = False,
    target_attach: str = "auto",
    target_object: int = -1,
    marker_map: Optional[Path] = None,
    marker_limit: float = 0.0,
    follow_pins: bool = False,
    initial_state: str = "scene",
    rest_shape: Optional[Path] = None,
    density: float = 0.1,
    pin_vertices: Union[str, Sequence[int], None] = "still",
    integrator: Union[str, int] = "tr_bdf2",
    steps_per_frame: int = 4,
    progress: Optional[Callable[[_core.Iteration], Any]] = None,
) -> _core.Estimate:
    """Recovers the scene's unknowns from how its cloths moved.

    The options are those of the program estimate_cloth, by the same names and with the
    same defaults; with the same options the results are the same. SI units.

    scene: a Scene or the path of one; one per target where there are several captures of
        one cloth. None: it is made of the target, a path to meshes (OBJ files).
    target: what was observed: an array (frames, vertices, 3) in m, NaN where a vertex was
        not seen; Observations; a Trajectory; or the path of a CSV, TRC, PC2 or NumPy file
        or of OBJ files. A list of these: several captures, fitted together. Of scenes with
        several objects give Observations. None: the scene's own motion, whose parameters
        then serve for nothing but parameter_deviation_percent.

    What is unknown
    settings: two letters per object, mass then stiffness, separated by commas. n: known,
        G: one value, L: one per vertex or spring, R: one per group; or "auto". None: as
        the scene says.
    estimate: more: "damping", "drag", "wind", "initial_velocity".
    prior, smoothness: what is known beforehand: "stiffness:lognormal:50,0.5;drag:normal:
        0.1,0.02", "stiffness=100,mass=auto".

    What is fitted
    frames: how many, the initial state included; None: as the scene says.
    validate_frames: over which the result is compared with the target afterwards.
    sigma: standard deviation of the target's noise (m), where it names none of its own.
    noise_sigma, seed: of normal noise to be added to the target.
    loss, loss_scale: what observations far from the model count: "none", "huber",
        "cauchy", "tukey"; the scale is in standard deviations of the noise, 0: its own.
    uncertainty: error bars: "auto", "on", "off".

    How
    init: "auto", "inverse_dynamics", "scene", "screen", "uniform:VALUE", or the parameter
        vector to start from, shape (parameters,).
    init_perturbation: multiplies every starting value by exp(this times a normal number).
    solver: "auto", "lm", "lbfgs". jacobian: "auto", "adjoint", "tangent". horizon: "auto",
        "full", "grow", "shooting".
    max_iterations, max_seconds: when to give up; None: the solver's own.
    threads: results agree to rounding whatever it is. memory_limit: MiB.
    checkpoint, resume: file in which to keep how far the fit has got, and from which to
        go on.

    Targets in files
    target_scale (m per unit), target_up ("y", "z"), target_rate (Hz), target_origin
        ("auto", "first", "file"), target_nan_is_missing, target_attach ("auto", "vertex",
        "position"), target_object, marker_map, marker_limit (m): as for estimate_cloth.
    rest_shape: an OBJ file, or "uv[:SIZE]". follow_pins: fixed vertices follow the target.
    initial_state: "scene", or "target": the vertices start where it shows them.

    Without a scene
    density (kg/m^2), pin_vertices ("still", indices, or None), integrator,
        steps_per_frame: of the scene that is made of the target.

    progress: called with an Iteration after every iteration, in the calling thread; the
        fit stops with the best so far when it returns something true.

    Returns an Estimate; look at its `converged` before using it. Raises SceneError for bad
    input. Ctrl-C stops the fit at once: the KeyboardInterrupt has the best so far, an
    Estimate, in its attribute `result` (None has been found yet if it lacks one). So has
    any exception that `progress` raises. The GIL is released.
    """
    options = dict(locals())
    for name in ("scene", "target", "progress"):
        del options[name]
    return _core._run_estimate(_as_list(scene), _as_list(target), options, progress)
