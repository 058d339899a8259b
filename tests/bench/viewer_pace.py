"""How many pictures a second the viewer draws while its light is dragged, as it counts them itself.

viewer_pace.py VIEWER SCENE [SIZE [SECONDS]]: starts the viewer on a display of its own (Xvfb), drags the light's center to and
fro (xdotool), and reads --status.
"""

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


def drag(path, environment, seconds):
    """Pictures a second and reductions, sampled after the first second."""
    def tool(*words):
        subprocess.run(["xdotool", *map(str, words)], env=environment, check=True)

    x, y = (round(v) for v in status(path)["handles"]["center"])
    tool("mousemove", x, y, "mousedown", 1)
    until(path, "the drag's start", lambda s: s.get("holding"))
    mouse = subprocess.Popen(["xdotool", "-"], env=environment, stdin=subprocess.PIPE, text=True)
    start, rates, reductions = time.monotonic(), [], collections.Counter()
    while (passed := time.monotonic() - start) < seconds:
        mouse.stdin.write(f"mousemove {x + round(60 * math.sin(2 * passed))} {y + round(20 * math.sin(3 * passed))}\n")
        mouse.stdin.flush()
        time.sleep(0.008)
        frame = status(path).get("frame")
        if frame and passed > 1.5:
            rates.append(frame["per_second"])
            reductions[frame["reduction"]] += 1
    mouse.stdin.close()
    mouse.wait()
    tool("mouseup", 1)
    return rates, reductions


def main():
    viewer, scene = sys.argv[1:3]
    size = sys.argv[3] if len(sys.argv) > 3 else "960x600"
    seconds = float(sys.argv[4]) if len(sys.argv) > 4 else 8.0
    server, display = start_display()
    environment = os.environ | {"DISPLAY": display}
    try:
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "status.json"
            window = subprocess.Popen([viewer, scene, "--size", size, "--status", path, "--output", folder],
                                      env=environment)
            try:
                until(path, "the first picture", lambda s: s.get("settled"))
                rates, reductions = drag(path, environment, seconds)
            finally:
                window.terminate()
                window.wait()
    finally:
        server.terminate()
        server.wait()
    shares = {f"1/{k}": round(n / sum(reductions.values()), 2) for k, n in sorted(reductions.items())}
    print(f"{scene} {size}: {statistics.median(rates)} pictures a second (least {min(rates)}, most {max(rates)}); "
          f"share of the time by reduction: {shares}")


if __name__ == "__main__":
    main()
