"""`cmake --install` of the module, below another prefix."""

import pathlib
import os
import subprocess
import sys

import dpe


def test_cmake_install(tmp_path):
    build = pathlib.Path(dpe.__file__).resolve().parents[2]
    subprocess.run(["cmake", "--install", build, "--component", "python", "--prefix",
                    tmp_path], check=True, capture_output=True)
    (package,) = tmp_path.rglob("__init__.py")
    folder = package.parent.parent
    version = f"python{sys.version_info.major}.{sys.version_info.minor}"
    assert folder.parent == tmp_path / "lib" / version
    done = subprocess.run(
        [sys.executable, "-c",
         "import dpe; print(dpe.__file__); dpe.simulate(dpe.Scene.grid(4, 4), 3)"],
        env={**os.environ, "PYTHONPATH": str(folder)}, cwd=tmp_path, check=True,
        capture_output=True, text=True)
    assert done.stdout.strip() == str(package)
