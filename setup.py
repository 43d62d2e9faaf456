"""`pip install .` builds the Python module with CMake; pyproject.toml has the rest.

Only the libraries that the module needs are built, in a folder that is removed
afterwards. What dpe is built on has to be there (tools/install_dependencies.sh).
CMAKE_ARGS in the environment is passed on to CMake.
"""

import os
import pathlib
import shlex
import subprocess
import sys
import tempfile

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

ROOT = pathlib.Path(__file__).resolve().parent


class CMakeBuild(build_ext):
    def build_extension(self, extension):
        package = pathlib.Path(self.get_ext_fullpath(extension.name)).resolve().parent
        with tempfile.TemporaryDirectory() as build:
            subprocess.run(
                ["cmake", "-S", str(ROOT), "-B", build, "-DCMAKE_BUILD_TYPE=Release",
                 f"-DPython_EXECUTABLE={sys.executable}", "-DBUILD_SHARED_LIBS=OFF",
                 "-DDPE_PYTHON_INSTALL_DIR=.", "-DDPE_WARNINGS_AS_ERRORS=OFF"]
                + [f"-DDPE_BUILD_{part}=OFF" for part in
                   ("TOOLS", "EXAMPLES", "TESTS", "VIEWER", "UNITY_PLUGIN", "BENCHMARKS")]
                + ["-DDPE_BUILD_PYTHON=ON"]
                + shlex.split(os.environ.get("CMAKE_ARGS", "")),
                check=True)
            jobs = os.environ.get("CMAKE_BUILD_PARALLEL_LEVEL", str(os.cpu_count() or 1))
            subprocess.run(["cmake", "--build", build, "--target", "dpe_python",
                            "--parallel", jobs], check=True)
            subprocess.run(["cmake", "--install", build, "--component", "python",
                            "--prefix", str(package.parent)], check=True)


setup(ext_modules=[Extension("dpe._core", sources=[])],
      cmdclass={"build_ext": CMakeBuild})
