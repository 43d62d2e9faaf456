"""What the tests of the Python module share: small scenes, the programs, their output."""

import os
import pathlib
import subprocess

import numpy as np
import pytest

import dpe

BIN = pathlib.Path(os.environ["DPE_BIN_DIR"])
DATA = pathlib.Path(os.environ["DPE_SOURCE_DIR"]) / "data"


def small_cloth(rows=4, cols=4, settings="nL", frames=10, **material):
    """A cloth without any symmetry, pinned at two corners, in a breeze."""
    scene = dpe.Scene.grid(rows, cols, 1.0, pins=[0, cols - 1], **material)
    random = np.random.default_rng(7)
    scene.rest_length = scene.rest_length.copy()
    free = ~scene.fixed
    scene.positions[free] += 0.02 * random.standard_normal((free.sum(), 3))
    scene.stiffness *= np.exp(0.2 * random.standard_normal(len(scene.stiffness)))
    scene.wind = [2.0, 0.5, -1.0]
    scene.settings = settings
    scene.frames = frames
    return scene


@pytest.fixture
def cloth():
    return small_cloth()


@pytest.fixture
def run_program():
    def run(name, *arguments):
        return subprocess.run(
            [BIN / name, *map(str, arguments)],
            check=True,
            capture_output=True,
            text=True,
        )

    return run
