"""`pip install .`: CMake builds and installs the module, setuptools packs what it installs. See docs/python.md."""
import os
import pathlib
import shutil
import subprocess
import sys

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

ROOT = pathlib.Path(__file__).resolve().parent
LEFT_OUT = ("CHECKS", "APPS", "TESTS")


def run(*words):
    subprocess.run([str(word) for word in words], check=True)


def configure(folder):
    words = ["cmake", "-S", ROOT, "-B", folder, "-DCMAKE_BUILD_TYPE=Release", "-DPENUMBRA_INSTALL=OFF", f"-DPython_EXECUTABLE={sys.executable}"]
    words += [f"-DPENUMBRA_BUILD_{part}=OFF" for part in LEFT_OUT]
    if shutil.which("ninja"):
        words += ["-G", "Ninja"]
    try:
        import pybind11
        words.append(f"-Dpybind11_DIR={pybind11.get_cmake_dir()}")
    except ImportError:  # Debian's pybind11-dev, which CMake finds
        pass
    run(*words)


class BuildByCMake(build_ext):
    def run(self):
        # A build that is there already, for the same interpreter: tests have one.
        folder = os.environ.get("PENUMBRA_BUILD_FOLDER")
        if not folder:
            folder = ROOT / "build" / "wheel"
            configure(folder)
        run("cmake", "--build", folder, "--parallel", os.cpu_count(), "--target", "penumbra_python")
        run("cmake", "--install", folder, "--component", "python", "--prefix", pathlib.Path(self.build_lib).resolve())


# What setuptools makes on the way stays in build/, too.
(ROOT / "build").mkdir(exist_ok=True)
setup(
    ext_modules=[Extension("penumbra._penumbra", sources=[])],
    cmdclass={"build_ext": BuildByCMake},
    options={"egg_info": {"egg_base": "build"}, "build": {"build_base": "build/setuptools"}},
)
