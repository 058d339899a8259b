"""A million points by Python's call and by the C++ call, and by as many rays a point as have the same RMSE, in one run.

usage: compare.py PROGRAM SCENE [--points N] [--rounds N] [--judged N] [--rays N] [--write FILE --commit C]

PROGRAM is penumbra_points_bench. The points form a square grid on the plane of the scene's lowest point, where most shadows are.
Python and C++ take turns; the ratio is that of the medians. Values must be equal bit by bit. Both RMSEs are of the same points in penumbra, by
rays in double, which share nothing with the module (tests/oracle); that of `reference` is measured at three numbers of rays, and the number
that is equal is read off a straight line through their logarithms.
"""
import argparse
import math
import os
import pathlib
import statistics
import subprocess
import sys
import tempfile
import time

import numpy as np
import penumbra

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[3] / "bench"))
from figures_file import spread, write  # noqa: E402

TRIED = (64, 256, 1024)


def grid(scene, count):
    side = math.isqrt(count)
    low, high = scene.bounds
    casters = [scene.mesh(i)[0] for i in range(len(scene))]
    smallest = min(casters, key=lambda V: np.ptp(V, axis=0).max())
    middle, reach = smallest.mean(axis=0), 1.5 * np.ptp(smallest, axis=0).max()
    x, z = np.meshgrid(np.linspace(-reach, reach, side), np.linspace(-reach, reach, side))
    return np.stack([middle[0] + x, np.full_like(x, low[1]), middle[2] + z], axis=-1).reshape(-1, 3).copy()


class Bench:
    def __init__(self, program, path, folder):
        self.program, self.path, self.folder = program, path, folder
        self.scene = penumbra.Scene.from_file(path)
        if len(self.scene.lights) != 1:
            sys.exit("a scene of one light is wanted")

    def run(self, *words):
        done = subprocess.run([self.program, *map(str, words)], capture_output=True, text=True)
        if done.returncode != 0:
            sys.exit(done.stderr)
        return done.stdout

    def file(self, name, points=None):
        path = os.path.join(self.folder, name)
        if points is not None:
            points.tofile(path)
        return path

    def cpp(self, points, calls, method="silhouette", samples="-"):
        """[(wall, CPU)] milliseconds of all calls but the first, and the values."""
        out = self.file("values")
        text = self.run("time", self.path, self.file("points", points), calls + 1, method, samples, out)
        times = [tuple(map(float, line.split())) for line in text.splitlines()]
        return times[1:], np.fromfile(out, np.float32)

    def python(self, points, calls, **options):
        times = []
        for _ in range(calls + 1):
            wall, cpu = time.monotonic(), time.process_time()
            values = self.scene.visibility(points, 0, **options)
            times.append((1e3 * (time.monotonic() - wall), 1e3 * (time.process_time() - cpu)))
        return times[1:], values

    def truth(self, points, rays):
        out = self.file("values")
        self.run("judge", self.path, self.file("points", points), rays, out)
        return np.fromfile(out, np.float32)


def compare(bench, points, rounds, record):
    mine, theirs = [], []
    for _ in range(rounds):
        times, values = bench.python(points, 2)
        mine += times
        times, expected = bench.cpp(points, 2)
        theirs += times
        if not np.array_equal(values, expected):
            sys.exit("Python's values are not those of C++")
    median = {}
    record["points"] = ("", [len(points)])
    for k, what in enumerate(("wall clock", "CPU")):
        python, cpp = (statistics.median(t[k] for t in times) for times in (mine, theirs))
        median[what] = python
        record[f"{what}/Python"], record[f"{what}/C++"] = ("ms", [t[k] for t in mine]), ("ms", [t[k] for t in theirs])
        record[f"{what}/Python : C++"] = ("", [python / cpp])
        print(f"{len(points):,} points, {what}: Python {python:.1f} ms, C++ {cpp:.1f} ms, ratio {python / cpp:.3f}")
    return values, median


def rmse(values, truth):
    return float(np.sqrt(np.mean((values.astype(float) - truth) ** 2)))


def equal_rays(bench, points, values, arguments, median, record):
    partly = np.flatnonzero((values > 0) & (values < 1))
    print(f"{len(partly):,} points in penumbra")
    chosen = np.random.default_rng(1).choice(partly, min(arguments.judged, len(partly)), replace=False)
    truth = bench.truth(points[chosen], arguments.rays)
    noise = rmse(bench.truth(points[chosen], arguments.rays // 4), truth)
    mine = rmse(values[chosen], truth)
    print(f"silhouette: RMSE {mine:.2g} of {len(chosen):,} points in penumbra, by {arguments.rays} rays in double; a quarter of those rays "
          f"differ by {noise:.2g} from all")
    errors = [rmse(bench.scene.visibility(points[chosen], 0, method="reference", samples=n), truth) for n in TRIED]
    slope, offset = np.polyfit(np.log(TRIED), np.log(errors), 1)
    for n, error in zip(TRIED, errors):
        print(f"reference, {n} rays: RMSE {error:.2g}")
    equal = math.exp((math.log(mine) - offset) / slope)
    print(f"of equal RMSE: {equal:.0f} rays a point")
    some = points[:: max(1, len(points) // 20_000)].copy()
    times, _ = bench.python(some, 1, method="reference", samples=TRIED[-1])
    record["rays of equal RMSE"], record["RMSE"] = ("rays", [equal]), ("visibility", [mine])
    whole = times[0][1] * len(points) / len(some) * equal / TRIED[-1]
    print(f"they would take {whole / 1e3:.0f} s of CPU for all points (measured: {TRIED[-1]} rays at each of {len(some):,}), "
          f"{whole / median['CPU']:.0f} times as long as silhouette")
    record["those rays : silhouette"] = ("", [whole / median["CPU"]])


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program")
    parser.add_argument("scene")
    parser.add_argument("--points", type=int, default=1_000_000)
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--judged", type=int, default=1_000)
    parser.add_argument("--rays", type=int, default=16_384)
    parser.add_argument("--write", type=pathlib.Path)
    parser.add_argument("--commit", default="unknown")
    arguments = parser.parse_args()
    record = {}
    with tempfile.TemporaryDirectory() as folder:
        bench = Bench(arguments.program, arguments.scene, folder)
        points = grid(bench.scene, arguments.points)
        values, median = compare(bench, points, arguments.rounds, record)
        equal_rays(bench, points, values, arguments, median, record)
    if arguments.write:
        scene = pathlib.Path(arguments.scene).stem
        write(arguments.write, arguments.commit, "python",
              {f"{scene}/{name}": spread(values) | {"unit": unit} for name, (unit, values) in record.items()})


main()
