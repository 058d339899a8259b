"""Makes the pictures of the viewer, on a display of its own.

usage: viewer.py FOLDER_OF_PROGRAMS [NAME...]

Needs xvfb, xdotool and python3-pil.
"""
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import time

from PIL import Image

HERE = pathlib.Path(__file__).resolve().parent
DATA = HERE.parent
# Of each picture: size, where the pointer is, words.
PICTURES = {
    "viewer-split": ("760x493", (452, 398), [HERE / "viewer-cube.json", "--method", "dbuffer", "--against", "reference", "--view",
                                             "split", "--overlay", "sheets", "--overlay", "band", "--probe"]),
    "viewer-difference": ("760x493", (900, 700), [HERE / "viewer-knot.json", "--method", "dbuffer", "--against", "silhouette",
                                                  "--view", "difference", "--overlay", "band"]),
    "viewer-solids": ("760x640", (900, 800), [HERE / "viewer-torus.json"]),
    "penumbra-volume": ("760x493", (900, 700), [DATA / "scenes/torus-medium.json", "--exposure", "2", "--overlay", "penumbra"]),
}
SHOWN, SIZE, GAP = (1, 5, 10, 15, 20, 24), (320, 200), 4  # of the sequence


def tool(*words):
    subprocess.run(["xdotool", *map(str, words)], check=True)


def until(done):
    for _ in range(1200):
        found = done()
        if found:
            return found
        time.sleep(0.1)
    raise TimeoutError("the viewer did not get there")


def status_of(path):
    try:
        return json.loads(path.read_text())
    except (OSError, ValueError):
        return {}


def write_sequence(viewer):
    """The light is moved by its slider to the other side, then Ctrl+P."""
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        status = folder / "status.json"
        window = subprocess.Popen([viewer, HERE / "viewer-bunny.json", "--size", "%dx%d" % (2 * SIZE[0], 2 * SIZE[1]), "--status", status,
                                   "--output", folder])
        until(lambda: status_of(status).get("settled"))
        tool("search", "--sync", "--name", "Penumbra", "windowfocus", "--sync")
        before = status_of(status)
        x, y = map(int, before["widgets"]["x"])  # the middle, 0
        tool("mousemove", x, y)
        tool("mousedown", 1)
        for step in range(1, 9):
            tool("mousemove", x + 2 * step, y)
            time.sleep(0.1)
        tool("mouseup", 1)
        until(lambda: status_of(status).get("settled") and status_of(status)["light"] != before["light"])
        tool("key", "ctrl+p")
        until(lambda: "24" in status_of(status).get("message", ""))
        files = until(lambda: (all := sorted(folder.glob("*-path-*.png")))[23:] and all)
        time.sleep(1)
        window.terminate()
        window.wait()
        sheet = Image.new("RGB", (3 * SIZE[0] + 4 * GAP, 2 * SIZE[1] + 3 * GAP), "white")
        for i, number in enumerate(SHOWN):
            at = (GAP + i % 3 * (SIZE[0] + GAP), GAP + i // 3 * (SIZE[1] + GAP))
            sheet.paste(Image.open(files[number - 1]).resize(SIZE, Image.Resampling.LANCZOS), at)
        sheet.save(HERE / "viewer-sequence.png", optimize=True)


def main():
    viewer = pathlib.Path(sys.argv[1]).resolve() / "penumbra-viewer"
    if "DISPLAY" not in os.environ or os.environ.get("PENUMBRA_PICTURES") != "1":
        os.execvpe("xvfb-run", ["xvfb-run", "-a", "-s", "-screen 0 1400x900x24 -noreset", sys.executable, *sys.argv],
                   dict(os.environ, PENUMBRA_PICTURES="1"))
    for name in sys.argv[2:] or [*PICTURES, "viewer-sequence"]:
        if name == "viewer-sequence":
            write_sequence(viewer)
            continue
        size, pointer, words = PICTURES[name]
        file = HERE / f"{name}.png"
        tool("mousemove", *pointer)
        subprocess.run([viewer, *words, "--size", size, "--screenshot", file], check=True)
        Image.open(file).save(file, optimize=True)


if __name__ == "__main__":
    main()
