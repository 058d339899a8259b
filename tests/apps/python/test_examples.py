"""The examples run at a small size and write a picture; the blocks of docs/python.md run one after the other."""
import os
import pathlib
import re
import subprocess
import sys

import penumbra
import pytest

TOP = pathlib.Path(__file__).resolve().parents[3]
EXAMPLES = TOP / "apps/python/examples"
ARGUMENTS = {
    "lamp_design.py": [TOP / "data/meshes/bunny.ply", "--size", "24"],
    "hours_map.py": [TOP / "data/sun/city-block.json", "--size", "24", "--minutes", "60"],
    "sun_hours.py": ["--size", "24", "--minutes", "60"],
    "ground_truth.py": [TOP / "data/scenes/torus-small.json", "--size", "48", "--rays", "16"],
}


def run(script, arguments, folder):
    environment = dict(os.environ, PYTHONPATH=str(pathlib.Path(penumbra.__file__).parents[1]), MPLCONFIGDIR=str(folder))
    return subprocess.run([sys.executable, "-B", script, *map(str, arguments)], cwd=folder, env=environment, text=True,
                          capture_output=True)


def test_every_example_is_tested():
    assert {path.name for path in EXAMPLES.glob("*.py")} == set(ARGUMENTS)


@pytest.mark.parametrize("name", sorted(ARGUMENTS))
def test_example(name, tmp_path):
    pytest.importorskip("matplotlib")
    done = run(EXAMPLES / name, [*ARGUMENTS[name], "--output", "out.png"], tmp_path)
    assert done.returncode == 0, done.stderr
    assert re.search(r"\d", done.stdout)
    assert (tmp_path / "out.png").stat().st_size > 5_000


def test_the_hours_of_sun_of_an_open_wall(tmp_path):
    """On an equinox the sun is up for 12 hours and never north of a wall that looks south."""
    pytest.importorskip("matplotlib")
    script = tmp_path / "alone.py"
    text = (EXAMPLES / "sun_hours.py").read_text()
    script.write_text(re.sub(r"BUILDINGS = .*", "BUILDINGS = [(-20, 20, -12, 0, 18)]", text))
    done = run(script, ["--size", "8", "--minutes", "60"], tmp_path)
    assert done.returncode == 0, done.stderr
    assert "facade: 12.00 to 12.00 hours" in done.stdout and "street: 12.00 to 12.00 hours" in done.stdout


def test_the_document(tmp_path):
    text = (TOP / "docs/python.md").read_text()
    blocks = re.findall(r"^```python\n(.*?)^```", text, re.M | re.S)
    assert len(blocks) >= 3
    (tmp_path / "data").symlink_to(TOP / "data")
    script = tmp_path / "document.py"
    script.write_text("\n".join(blocks))
    done = run(script, [], tmp_path)
    assert done.returncode == 0, done.stderr
