"""Recovers the material of a cloth from a few markers on it, and draws what was found.

Forty markers between the vertices are seen at 50 Hz, out of step with the simulation,
with 2 mm of noise and some gaps. Unknown are one stiffness for each kind of spring
(stretch, shear, bend), the damping and the drag.

    python3 recover_from_markers.py [PICTURE]
"""

import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

import dpe

NOISE = 0.002  # m


def film(scene, random):
    """What the camera saw: (vertices, weights, times, positions) of the markers."""
    triangles = random.choice(len(scene.triangles), 40, replace=False)
    vertices = scene.triangles[triangles]
    weights = random.dirichlet([2, 2, 2], len(vertices))
    times = np.arange(1, scene.frames - 2) + 0.3
    motion = dpe.simulate(scene)
    positions = dpe.marker_positions(motion, vertices, weights, times)
    positions += NOISE * random.standard_normal(positions.shape)
    positions[random.random(positions.shape[:2]) < 0.15] = np.nan  # not seen
    return vertices, weights, times, positions


def draw(found, truth, names, seen, predicted, start, times, picture):
    figure, (left, right) = plt.subplots(1, 2, figsize=(10, 4), layout="constrained")
    rms = [i.rms for i in found.history]
    left.semilogy(1000 * np.array(rms), "o-", color="C0")
    left.axhline(1000 * NOISE * np.sqrt(3), color="0.5", ls="--", label="noise")
    left.set(xlabel="iteration", ylabel="position error (mm, RMS)",
             title=f"{found.solver}, {found.iterations} iterations")
    left.legend()
    marker = int(np.argmax(np.nanstd(seen[:, :, 1], axis=0)))
    right.plot(times, seen[:, marker, 1], ".", color="0.6", label="seen")
    right.plot(times, start[:, marker, 1], ":", color="C3", label="where the fit began")
    right.plot(times, predicted[:, marker, 1], color="C0", label="fitted")
    right.set(xlabel="frame", ylabel="height (m)", title="the marker that moves most")
    right.legend()
    lines = [f"{n}: {p:.3g} ± {s:.1g} (true {t:.3g})" for n, p, s, t in
             zip(names, found.parameters, found.standard_deviations, truth)]
    figure.suptitle(",  ".join(lines), fontsize=8)
    figure.savefig(picture, dpi=120)


def main(picture="recover_from_markers.png"):
    random = np.random.default_rng(1)
    scene = dpe.Scene.preset("corners", rows=12, cols=12, traction_stiffness=45.0,
                             bending_stiffness=9.0, shear_stiffness=25.0)
    # A spring's stiffness follows from where it is in the grid. One value for each kind
    # is a model that can be exact, so that errors are the noise's alone.
    for kind, stiffness in (("stretch", 45.0), ("shear", 25.0), ("bend", 9.0)):
        scene.stiffness[scene.spring_kind == kind] = stiffness
    scene.frames = 60
    scene.wind = [3.0, 1.0, 2.0]
    scene.settings = "nR"
    scene.estimate_damping = scene.estimate_drag = True
    truth = scene.parameters
    names = ["stretch (N/m)", "shear", "bend", "damping (1/s)", "drag"]
    vertices, weights, times, seen = film(scene, random)

    guess = scene.with_parameters([20.0, 20.0, 20.0, 0.3, 0.3])
    observations = dpe.Observations(sigma=NOISE)
    observations.add_markers(vertices, weights, times, seen)
    found = dpe.estimate(guess, observations, init="scene", horizon="full",
                         progress=lambda i: print(f"{i.iteration:3d} {i.rms:.4e} m"))
    print(found.message)
    print(found.uncertainty)
    off = (found.parameters - truth) / found.standard_deviations
    print("off by", np.round(off, 2), "standard deviations")
    draw(found, truth, names, seen,
         dpe.marker_positions(found.trajectory, vertices, weights, times),
         dpe.marker_positions(dpe.simulate(guess), vertices, weights, times), times,
         picture)
    return off


if __name__ == "__main__":
    main(*sys.argv[1:])
