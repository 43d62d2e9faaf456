"""`pip install .` from the source tree, into a folder of its own, from scratch."""

import os
import pathlib
import shutil
import subprocess
import sys

import numpy as np
import pytest

import dpe
from conftest import DATA

ROOT = pathlib.Path(os.environ["DPE_SOURCE_DIR"])


def test_pip_install(tmp_path):
    pytest.importorskip("setuptools", reason="needs setuptools")
    pytest.importorskip("wheel", reason="needs wheel")
    # A copy: what an unpacked archive of the sources is, without any build output.
    source = tmp_path / "source"
    shutil.copytree(ROOT, source, ignore=shutil.ignore_patterns(
        ".git", "build*", "results", "shared", "*.egg-info", "__pycache__"))
    target = tmp_path / "packages"
    subprocess.run(
        [sys.executable, "-m", "pip", "install", "--no-build-isolation", "--no-index",
         "--no-deps", "--no-cache-dir", "--target", target, "."],
        cwd=source, check=True, capture_output=True, text=True)
    assert {p.name.split(".")[0] for p in (target / "dpe").iterdir()} >= {
        "__init__", "_core", "_estimate", "py"}
    assert not (source / "build").exists()
    code = ("import sys, dpe, numpy; print(dpe.__file__);"
            "numpy.save(sys.argv[2], dpe.simulate(dpe.Scene.load(sys.argv[1]), 9)"
            ".positions)")
    environment = {**os.environ, "PYTHONPATH": str(target)}
    done = subprocess.run(
        [sys.executable, "-c", code, DATA / "flag.txt", tmp_path / "motion.npy"],
        cwd=tmp_path, env=environment, check=True, capture_output=True, text=True)
    assert done.stdout.startswith(str(target))
    expected = dpe.simulate(dpe.Scene.load(DATA / "flag.txt"), 9).positions
    assert (np.load(tmp_path / "motion.npy") == expected).all()
