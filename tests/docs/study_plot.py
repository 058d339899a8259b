"""Draws the study's one plot: time against error over all scenes of a study.csv, with the front of the best, as SVG.

usage: study_plot.py study.csv plot.svg

A point is a setting that every scene has: the geometric mean of frame times, the root mean square of errors. Where the interval
of an RMSE reaches 0 its upper end counts.
"""
import csv
import math
import sys
from collections import defaultdict

WIDTH, HEIGHT, LEFT, BOTTOM, TOP, RIGHT = 1000, 480, 66, 52, 14, 176
# Readable on white and on dark.
COLORS = {"silhouette": "#2f81d8", "reference": "#85898f", "rays": "#d88a1d", "hard": "#9a9f22", "none": "#b565c1",
          "dbuffer": "#d8473d", "occlusion-textures": "#1aa37c"}
# Squares, so that a color may be that of a circle, too.
OTHERS = ["#5b6ee1", "#c4569b", "#3aa0b8", "#8a5a32", "#6f9a3a", "#d88a1d", "#2f81d8", "#d8473d", "#1aa37c", "#b565c1", "#9a9f22"]
LEAST = 5e-5  # what references of 4,096 rays tell from 0


def error_of(row):
    return float(row["rmse"] if float(row["rmse_low"]) > 0 else row["rmse_high"])


def points_of(rows):
    scenes = {row["scene"] for row in rows}
    by_setting = defaultdict(dict)
    for row in rows:
        if row["frame_ms"] and row["rmse"]:
            by_setting[row["method"], row["setting"]][row["scene"]] = (float(row["frame_ms"]), error_of(row))
    for (method, setting), values in by_setting.items():
        if set(values) == scenes:
            times, errors = zip(*values.values())
            yield (math.exp(sum(map(math.log, times)) / len(times)),
                   max(LEAST, math.sqrt(sum(e * e for e in errors) / len(errors))), method, setting)


def front_of(points):
    front = []
    for point in sorted(points):
        if not front or point[1] < front[-1][1]:
            front.append(point)
    return front


def axis(low, high, start, end):
    def place(value):
        return start + (end - start) * math.log(value / low) / math.log(high / low)
    digits = [1] if high / low > 3e3 else [1, 2, 5]
    ticks = [d * 10.0 ** p for p in range(math.floor(math.log10(low)), math.ceil(math.log10(high)) + 1) for d in digits]
    return place, [t for t in ticks if low <= t <= high]


def number(value):
    return f"{value:.10f}".rstrip("0").rstrip(".")


def mark(x, y, size, color, is_round, more=""):
    """A circle or a square of the same area."""
    shape = (f'<circle cx="{x:.1f}" cy="{y:.1f}" r="{size}"' if is_round else
             f'<rect x="{x - .9 * size:.1f}" y="{y - .9 * size:.1f}" width="{1.8 * size:.1f}" height="{1.8 * size:.1f}"')
    return f'{shape} fill="{color}"{more}'


def svg_of(points):
    xs, ys = [p[0] for p in points], [p[1] for p in points]
    x, x_ticks = axis(min(xs) / 1.2, max(xs) * 1.2, LEFT, WIDTH - RIGHT)
    y, y_ticks = axis(min(ys) / 1.3, max(ys) * 1.3, HEIGHT - BOTTOM, TOP)
    out = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {HEIGHT}" font-family="sans-serif" font-size="13" fill="#777">']
    for t in x_ticks:
        out.append(f'<line x1="{x(t):.1f}" x2="{x(t):.1f}" y1="{TOP}" y2="{HEIGHT - BOTTOM}" stroke="#8884"/>'
                   f'<text x="{x(t):.1f}" y="{HEIGHT - BOTTOM + 17}" text-anchor="middle">{number(t)}</text>')
    for t in y_ticks:
        out.append(f'<line x1="{LEFT}" x2="{WIDTH - RIGHT}" y1="{y(t):.1f}" y2="{y(t):.1f}" stroke="#8884"/>'
                   f'<text x="{LEFT - 6}" y="{y(t) + 4:.1f}" text-anchor="end">{number(t)}</text>')
    path = ""
    for time, error, _, _ in front_of(points):
        path += f"H{x(time):.1f}V{y(error):.1f}" if path else f"M{x(time):.1f} {y(error):.1f}"
    out.append(f'<path d="{path}" fill="none" stroke="#777" stroke-width="2"/>')
    methods = list(dict.fromkeys(p[2] for p in points))
    others = iter(OTHERS)
    colors = {m: COLORS.get(m) or next(others, "#777") for m in methods}
    best = set(front_of(points))
    for p in points:
        is_round = p[2] in COLORS
        out.append(mark(x(p[0]), y(p[1]), 6 if p in best else 4, colors[p[2]], is_round,
                        f' fill-opacity="{1 if p in best else .55}"><title>{p[3]}: {p[0]:.1f} ms, {p[1]:.2g}</title>'
                        f'</{"circle" if is_round else "rect"}>'))
    for k, m in enumerate(methods):
        out.append(mark(WIDTH - RIGHT + 18, TOP + 16 + 21 * k, 5, colors[m], m in COLORS, "/>") +
                   f'<text x="{WIDTH - RIGHT + 30}" y="{TOP + 20 + 21 * k}">{m}</text>')
    out.append(f'<text x="{(LEFT + WIDTH - RIGHT) / 2}" y="{HEIGHT - 10}" text-anchor="middle">milliseconds a frame</text>'
               f'<text transform="translate(16 {HEIGHT / 2}) rotate(-90)" text-anchor="middle">error where the shadow is soft (RMSE)</text></svg>')
    return "\n".join(out) + "\n"


def main():
    with open(sys.argv[1], newline="") as text:
        rows = [row for row in csv.DictReader(text) if not row["refused"] and not row["sweep"]]
    points = list(points_of(rows))
    if not points:
        sys.exit(f"{sys.argv[1]}: no setting that every scene has")
    with open(sys.argv[2], "w") as out:
        out.write(svg_of(points))


main()
