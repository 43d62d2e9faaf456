"""Speed against accuracy: error after one second over the time a frame takes.

    python3 speed_accuracy.py [PICTURE]
"""
import sys
import time
import matplotlib
matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
import dpe

METHODS = ("symplectic_euler", "linearly_implicit_euler", "implicit_euler", "tr_bdf2")

def main(picture="speed_accuracy.png", frames=51):
    scene = dpe.Scene.preset("corners", rows=12, cols=12)
    scene.integration_method, scene.steps_per_frame = "tr_bdf2", 256
    exact = dpe.simulate(scene, frames).positions[-1]
    figure, axes = plt.subplots(figsize=(6, 4.5), layout="constrained")
    for method in METHODS:
        milliseconds, errors = [], []
        for scene.steps_per_frame in (1, 2, 4, 8, 16, 32):
            scene.integration_method = method
            begin = time.process_time()
            motion = dpe.simulate(scene, frames, check=False)
            if motion.ok:  # explicit methods need short steps
                milliseconds.append(1e3 * (time.process_time() - begin) / (frames - 1))
                errors.append(np.sqrt(((motion.positions[-1] - exact) ** 2).sum(1).mean()))
        axes.loglog(milliseconds, errors, "o-", label=method.replace("_", " "))
    axes.set(xlabel="processor time of a frame (ms)", ylabel="error after 1 s (m, RMS)",
             title="12 x 12 vertices, 1 to 32 steps per frame")
    axes.legend()
    figure.savefig(picture, dpi=120)

if __name__ == "__main__":
    main(*sys.argv[1:])
