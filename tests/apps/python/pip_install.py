"""`pip install .` without a network, into an environment of its own that sees Debian's packages; then the module works from there.

usage: pip_install.py SOURCE BUILD

BUILD is a build of the module for this interpreter: pip packs what it has. Ends with 77 where venv, pip, setuptools or wheel are missing.
"""
import os
import pathlib
import subprocess
import sys
import tempfile

try:
    import ensurepip  # noqa: F401
    import numpy  # noqa: F401
    import setuptools  # noqa: F401
    import wheel  # noqa: F401
except ImportError as error:
    print(f"{error}: install python3-venv, python3-setuptools, python3-wheel and python3-numpy")
    sys.exit(77)

TRIAL = """
import numpy as np, pathlib, penumbra
plate = np.array([[-0.5, 1, -0.5], [0.5, 1, -0.5], [0.5, 1, 0.5], [-0.5, 1, 0.5]])
scene = penumbra.Scene(plate, np.array([[0, 2, 1], [0, 3, 2]]))
lamp = penumbra.DiskLight(center=(0, 3, 0), normal=(0, -1, 0), radius=0.2)
assert list(scene.visibility(np.array([[0.0, 0, 0], [5, 0, 0]]), lamp)) == [0, 1]
print(pathlib.Path(penumbra.__file__).parent)
"""

source, build = (pathlib.Path(word).resolve() for word in sys.argv[1:])
with tempfile.TemporaryDirectory() as folder:
    place = pathlib.Path(folder).resolve() / "environment"
    subprocess.run([sys.executable, "-m", "venv", "--system-site-packages", place], check=True)
    environment = {**os.environ, "PENUMBRA_BUILD_FOLDER": str(build), "PIP_NO_INDEX": "1"}
    for name in ("PYTHONPATH", "PIP_FIND_LINKS"):
        environment.pop(name, None)
    subprocess.run([place / "bin/pip", "install", "--no-build-isolation", source], check=True, env=environment, cwd=folder)
    found = subprocess.run([place / "bin/python", "-c", TRIAL], check=True, env=environment, cwd=folder, text=True, capture_output=True).stdout.strip()
    assert pathlib.Path(found).is_relative_to(place), found
    modules = sorted(p.name for p in pathlib.Path(found).iterdir())
    print("installed:", *modules)
    assert "py.typed" in modules and "__init__.pyi" in modules, modules
    left = {"penumbra.egg-info"} & {p.name for p in source.iterdir()}
    assert not left, left
