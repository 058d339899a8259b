"""How many pictures a second the viewer draws while its light is dragged, as it counts them itself.

viewer_pace.py VIEWER [SCENE...] [--size WxH] [--seconds S] [--write FILE --commit C]: for each scene starts the viewer on a
display of its own (Xvfb), drags the light's center to and fro (xdotool), and reads --status. Prints pictures a second, which part of
the time they had full size, and what a picture took of the processors: the viewer's share does not depend on what else runs.
"""

import argparse
import collections
import json
import math
import os
import pathlib
import statistics
import subprocess
import sys
import tempfile
import time

from figures_file import spread, write

SCENES = ["cube-medium", "bunny-medium", "armadillo-medium"]
ROOT = pathlib.Path(__file__).resolve().parents[2]


def status(path):
    try:
        return json.loads(path.read_text())
    except (OSError, json.JSONDecodeError):
        return {}


def until(path, what, so, seconds=60):
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        now = status(path)
        if so(now):
            return now
        time.sleep(0.02)
    sys.exit(f"viewer_pace: waited in vain for {what}")


def start_display():
    read, write = os.pipe()
    server = subprocess.Popen(["Xvfb", "-displayfd", str(write), "-screen", "0", "1600x1000x24", "-nolisten", "tcp"],
                              pass_fds=[write], stderr=subprocess.DEVNULL)
    os.close(write)
    with os.fdopen(read) as pipe:
        return server, ":" + pipe.readline().strip()


def processor_ms(process):
    """Of all threads, user and system."""
    fields = pathlib.Path(f"/proc/{process.pid}/stat").read_text().rpartition(")")[2].split()
    return (int(fields[11]) + int(fields[12])) * 1000.0 / os.sysconf("SC_CLK_TCK")


class Samples:
    """What is read while the light is dragged."""

    def __init__(self):
        self.rates, self.milliseconds, self.reductions = [], [], collections.Counter()
        self.first, self.last = None, None

    def add(self, frame, *processes):
        self.rates.append(frame["per_second"])
        self.milliseconds.append(frame["milliseconds"])
        self.reductions[frame["reduction"]] += 1
        self.last = (frame["number"], *map(processor_ms, processes))
        self.first = self.first or self.last

    def figures(self):
        pictures, viewer, server = (b - a for a, b in zip(self.first, self.last))
        return {"pictures a second": ("1/s", self.rates),
                "a picture": ("ms", self.milliseconds),
                "full size": ("1", [self.reductions[1] / sum(self.reductions.values())]),
                "processor": ("ms a picture, all threads", [viewer / max(pictures, 1)]),
                "processor of the display": ("ms a picture", [server / max(pictures, 1)])}


def drag(path, environment, seconds, window, server):
    """Samples after the first second and a half."""
    def tool(*words):
        subprocess.run(["xdotool", *map(str, words)], env=environment, check=True)

    x, y = (round(v) for v in status(path)["handles"]["center"])
    tool("mousemove", x, y, "mousedown", 1)
    until(path, "the drag's start", lambda s: s.get("holding"))
    mouse = subprocess.Popen(["xdotool", "-"], env=environment, stdin=subprocess.PIPE, text=True)
    start, samples = time.monotonic(), Samples()
    while (passed := time.monotonic() - start) < seconds:
        mouse.stdin.write(f"mousemove {x + round(60 * math.sin(2 * passed))} {y + round(20 * math.sin(3 * passed))}\n")
        mouse.stdin.flush()
        time.sleep(0.008)
        frame = status(path).get("frame")
        if frame and passed > 1.5:
            samples.add(frame, window, server)
    mouse.stdin.close()
    mouse.wait()
    tool("mouseup", 1)
    return samples.figures()


def measure(viewer, scene, size, seconds):
    server, display = start_display()
    environment = os.environ | {"DISPLAY": display}
    try:
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "status.json"
            window = subprocess.Popen([viewer, scene, "--size", size, "--status", path, "--output", folder],
                                      env=environment)
            try:
                until(path, "the first picture", lambda s: s.get("settled"))
                return drag(path, environment, seconds, window, server)
            finally:
                window.terminate()
                window.wait()
    finally:
        server.terminate()
        server.wait()


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("viewer")
    parser.add_argument("scenes", nargs="*", default=SCENES, help="names of data/scenes, or files")
    parser.add_argument("--size", default="960x600")
    parser.add_argument("--seconds", type=float, default=8.0)
    parser.add_argument("--write", type=pathlib.Path)
    parser.add_argument("--commit", default="unknown")
    arguments = parser.parse_args()
    record = {}
    for scene in arguments.scenes:
        file = ROOT / "data/scenes" / (scene + ".json")
        figures = measure(arguments.viewer, file if file.exists() else scene, arguments.size, arguments.seconds)
        for name, (unit, values) in figures.items():
            key = f"{scene}/{arguments.size}/{name}"
            record[key] = spread(values) | {"unit": unit}
            print(f"  {key:56} {record[key]['median']:10.5g} {unit}", flush=True)
    if arguments.write:
        write(arguments.write, arguments.commit, "viewer", record)


if __name__ == "__main__":
    main()
