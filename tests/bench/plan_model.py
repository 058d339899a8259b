"""The planner's model of times and errors: measures rows, fits constants to them, says how far the fit is off.

  plan_model.py rows PENUMBRA ROWS.json [CASE...]   measures all cases or those named, and replaces their rows
  plan_model.py facts PENUMBRA ROWS.json             asks the planner again, and keeps the times
  plan_model.py fit ROWS.json HEADER DOCUMENT        writes the constants, and how far they are off into the document
  plan_model.py example PENUMBRA DOCUMENT            writes what `penumbra plan` says of the document's scene into it

A row is a scene: what `penumbra plan --json` says of it, and for each method the processor's time of a frame's visibility,
halved for two cores, the time of what is made once, and the RMSE over penumbra against the silhouette method's picture
(whose own error is some .0005 by rays in double). Processor time, not wall time: other work on the machine changes it less.
"""
import json
import math
import os
import random
import resource
import subprocess
import sys
import tempfile
from pathlib import Path

TOP = Path(__file__).resolve().parents[2]
SCENES = """cube-medium sphere-medium torus-large boxes-large boxes-sun foliage-small foliage-medium triangle-medium
    bunny-small bunny-medium knot1-medium knot1-large armadillo-small armadillo-medium armadillo-large
    refined_elephant-medium decorativePlant-small decorativePlant-medium building terrain-sun room contact figure7
    tree""".split()
# Triangles strewn by chance: how many, their size, the light's radius.
SOUPS = [(200, .05, .5), (500, .05, .5), (2000, .05, .2), (2000, .05, 1), (5000, .02, .5), (20000, .02, .3),
         (20000, .2, .5), (20000, .02, 1.5), (6000, .1, 3), (20000, .1, 1)]
SETTINGS = {"silhouette": ("silhouette", 0), "reference-16": ("reference", 16), "rays-16": ("rays", 16),
            "rays-144": ("rays", 144)}
SIZE = ["--size", "320x240"]


def soup_mesh(path, count, size, seed):
    chance = random.Random(seed)
    lines = [f"OFF\n{3 * count} {count} 0"]
    for _ in range(count):
        center = (chance.uniform(-1, 1), chance.uniform(.2, 1.2), chance.uniform(-1, 1))
        for _ in range(3):
            lines.append(" ".join(f"{c + chance.gauss(0, size):.6f}" for c in center))
    lines += [f"3 {3 * i} {3 * i + 1} {3 * i + 2}" for i in range(count)]
    path.write_text("\n".join(lines) + "\n")


def write_soup(folder, count, size, radius):
    name = f"soup-{count}-{size:g}-{radius:g}"
    soup_mesh(folder / f"{name}.off", count, size, count)
    (folder / f"{name}.json").write_text(json.dumps({
        "version": 1,
        "lights": [{"shape": "disk", "center": [0, 4, 0], "normal": [0, -1, 0], "radius": radius}],
        "camera": {"eye": [3, 3.5, 5], "target": [0, .4, 0], "fov_y_degrees": 40},
        "objects": [{"mesh": f"{name}.off"}, {"mesh": str(TOP / "data/scenes/floor.off"), "casts": False}]}))
    return name, folder / f"{name}.json"


def write_fan(folder, pleats, radius):
    """A pleated fan: every edge is a silhouette for some receiver."""
    name, lines = f"fan-{pleats}-{radius:g}", []
    for i in range(2 * pleats):
        angle, far, high = math.pi * i / pleats, (1.0 if i % 2 else .98), (.9 if i % 2 else .5)
        lines.append(f"{far * math.cos(angle):.9f} {high} {far * math.sin(angle):.9f}")
    faces = [f"3 0 {i + 1} {(i + 1) % (2 * pleats) + 1}" for i in range(2 * pleats)]
    (folder / f"{name}.off").write_text("\n".join(
        [f"OFF\n{2 * pleats + 1} {2 * pleats} 0", "0 .7 0"] + lines + faces) + "\n")
    scene = json.loads((folder / "soup-200-0.05-0.5.json").read_text())
    scene["lights"][0]["radius"] = radius
    scene["objects"][0]["mesh"] = f"{name}.off"
    (folder / f"{name}.json").write_text(json.dumps(scene))
    return name, folder / f"{name}.json"


def processor_seconds(command):
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def frame_and_first(penumbra, scene, words, output):
    """Milliseconds of a frame and of the first one with all that comes before, on two cores."""
    command = [penumbra, "render", str(scene), *words, *SIZE, "--output", str(output)]
    first = processor_seconds(command)
    more = 1 if first > 2 else 8
    return 500 * (processor_seconds(command + ["--warm-up", str(more)]) - first) / more, 500 * first


def facts_of(penumbra, scene):
    command = [penumbra, "plan", str(scene), *SIZE, "--json"]
    return json.loads(subprocess.run(command, check=True, capture_output=True).stdout)["lights"][0]["facts"]


def measure(penumbra, scene, folder):
    row = {"facts": facts_of(penumbra, scene), "measured": {}}
    none_frame, none_first = frame_and_first(penumbra, scene, ["--method", "none"], folder / "none.exr")
    for name, (method, samples) in SETTINGS.items():
        words = ["--method", method] + (["--samples", str(samples)] if samples else [])
        frame, first = frame_and_first(penumbra, scene, words, folder / f"{name}.exr")
        row["measured"][name] = {"frame_ms": round(frame - none_frame, 2),
                                 "setup_ms": round(first - none_first - (frame - none_frame), 2)}
        if samples:
            command = [penumbra, "compare", str(folder / f"{name}.exr"), str(folder / "silhouette.exr"), "--json"]
            figures = json.loads(subprocess.run(command, check=True, capture_output=True).stdout)
            row["measured"][name]["rmse"] = round(figures["penumbra"]["rmse"], 5)
    return row


def write_cases(folder):
    cases = dict(write_soup(folder, *soup) for soup in SOUPS)
    cases |= {name: TOP / f"data/scenes/{name}.json" for name in SCENES}
    return cases | dict([write_fan(folder, 4000, .5), write_fan(folder, 300, 1)])


def write_rows(path, rows):
    path.write_text("{\n" + ",\n".join(f"{json.dumps(name)}: {json.dumps(row)}" for name, row in sorted(rows.items())) + "\n}\n")


def measure_rows(penumbra, path, names):
    rows = json.loads(path.read_text()) if path.exists() else {}
    with tempfile.TemporaryDirectory() as temporary:
        cases = write_cases(Path(temporary))
        for name in names or cases:
            rows[name] = measure(penumbra, cases[name], Path(temporary))
            write_rows(path, rows)
            print(name, json.dumps(rows[name]["measured"]), flush=True)


def ask_again(penumbra, path):
    rows = json.loads(path.read_text())
    with tempfile.TemporaryDirectory() as temporary:
        cases = write_cases(Path(temporary))
        for name, row in rows.items():
            row["facts"] = facts_of(penumbra, cases[name])
    write_rows(path, rows)


def total(constants, features):
    return sum(c * f for c, f in zip(constants, features))


def fit_constants(features, values):
    """Constants of at least 0 for which the sum of squared logarithms of model / value is least: steps of single constants,
    from where each alone would explain an equal part."""
    count = len(features[0])
    loss = lambda constants: sum(math.log(max(total(constants, row), 1e-9) / v) ** 2 for row, v in zip(features, values))
    scale = [sum(values) / max(1e-9, sum(row[k] for row in features)) for k in range(count)]
    constants = [s / count for s in scale]
    best = loss(constants)
    for steps in [(0, .25, .5, 2, 4), (.8, 1.25), (.95, 1.05), (0, .99, 1.01)] * 3:
        improved = True
        while improved:
            improved = False
            for k, step in ((k, step) for k in range(count) for step in steps):
                tried = list(constants)
                tried[k] = step * (constants[k] or .01 * scale[k])
                if (now := loss(tried)) < best * (1 - 1e-6):
                    constants, best, improved = tried, now, True
    return constants


def mean(facts, number):
    """Over the parts of the receivers, of a number of a part."""
    return sum(facts[part]["share"] * number(facts[part]) for part in ("lit", "penumbra", "hidden"))


def reached(facts):
    return facts["receivers"] - facts["dark_receivers"]


def silhouette_features(facts):
    return [reached(facts), facts["edges"], reached(facts) * mean(facts, lambda p: p["merged_edges"]),
            reached(facts) * mean(facts, lambda p: math.sqrt(p["edges"])),
            reached(facts) * mean(facts, lambda p: p["edge_length"]), reached(facts) * mean(facts, lambda p: p["boxes"])]


def ray_features(facts, part):
    return [1, math.log2(1 + facts["faces"]), math.sqrt(part["boxes"]), math.sqrt(part["edges"])]


def reference_features(facts, samples):
    parts = [facts[part] for part in ("lit", "penumbra", "hidden")]
    sums = [sum(part["share"] * f for part, f in zip(parts, fs)) for fs in zip(*(ray_features(facts, p) for p in parts))]
    return [samples * reached(facts) * f for f in sums]


def open_ns(facts, samples, ray, part):
    """Of rays at the receivers of a part that may be left open by certificates."""
    edges = 1 if part == "penumbra" else min(1, facts[part]["edges"])
    return reached(facts) * facts[part]["share"] * edges * samples * total(ray, ray_features(facts, facts[part]))


def rays_features(facts, samples, ray):
    return [reached(facts), facts["edges"], reached(facts) * mean(facts, lambda p: math.sqrt(p["edges"])),
            reached(facts) * mean(facts, lambda p: p["edges"]), reached(facts) * mean(facts, lambda p: p["boxes"]),
            open_ns(facts, samples, ray, "penumbra"),
            open_ns(facts, samples, ray, "hidden") + open_ns(facts, samples, ray, "lit")]


def rays_error(facts, samples):
    chance, boundary = facts["variance"] / samples, facts["boundary"] / samples ** 1.5
    return math.sqrt(chance * boundary / (chance + boundary))


def replace_block(document, begin, text):
    """What stands between the line that begins so and the next end mark."""
    before, mark, after = document.read_text().partition(begin)
    if not mark:
        sys.exit(f"{document}: no line {begin}")
    line, _, after = after.partition("\n")
    after = after[after.index("<!-- end -->"):]
    document.write_text(f"{before}{begin}{line}\n{text.strip()}\n{after}")


def write_example(penumbra, document):
    scene = document.read_text().partition("<!-- plan: ")[2].partition(" -->")[0]
    text = subprocess.run([penumbra, "plan", scene], check=True, capture_output=True, text=True, cwd=TOP).stdout
    replace_block(document, "<!-- plan: ", f"```text\n{text}```")


class Model:
    """The constants, and what they say of a scene's facts, nanoseconds."""

    def __init__(self, rows):
        facts = [row["facts"] for row in rows.values()]
        ns = lambda name: [max(1.0, row["measured"][name]["frame_ms"]) * 1e6 for row in rows.values()]
        self.silhouette = fit_constants([silhouette_features(f) for f in facts], ns("silhouette"))
        self.ray = fit_constants([reference_features(f, 16) for f in facts], ns("reference-16"))
        self.rays = fit_constants([rays_features(f, n, self.ray) for n in (16, 144) for f in facts],
                                  ns("rays-16") + ns("rays-144"))
        setups = [(f["edges"], row["measured"]["silhouette"]["setup_ms"] * 1e6) for f, row in zip(facts, rows.values())]
        setups = [(edges, time) for edges, time in setups if time > 1e7]
        self.hierarchy = fit_constants([[edges] for edges, _ in setups], [time for _, time in setups])[0]

    def of_silhouette(self, facts):
        return total(self.silhouette, silhouette_features(facts))

    def of_reference(self, facts, samples):
        return total(self.ray, reference_features(facts, samples))

    def of_rays(self, facts, samples):
        return total(self.rays, rays_features(facts, samples, self.ray))


def fit(path, header, document):
    rows = json.loads(path.read_text())
    model = Model(rows)
    write_header(header, model)
    residuals = residuals_of(rows, model) + "\n" + regrets(rows)
    print(residuals)
    replace_block(document, "<!-- residuals -->", residuals)


def write_header(path, model):
    names = [("Silhouette", ["Receiver", "BandEdge", "Merged", "RootOfEdges", "Length", "Box"], model.silhouette),
             ("Ray", ["", "LogFaces", "RootOfBoxes", "RootOfEdges"], model.ray),
             ("Rays", ["Receiver", "BandEdge", "RootOfEdges", "Edge", "Box", "OpenPenumbra", "OpenRest"], model.rays),
             ("Hierarchy", ["Edge"], [model.hierarchy])]
    lines = [f"inline constexpr double k{group}{name} = {value:.4g};"
             for group, members, values in names for name, value in zip(members, values)]
    path.write_text("// Constants of the planner's model. Made by `./run plan-model` from data/plan/rows.json: do not edit.\n"
                    "#pragma once\n\nnamespace penumbra::detail::fit {\n\n// Nanoseconds on two cores; kRaysOpen...: shares.\n"
                    + "\n".join(lines) + "\n\n}  // namespace penumbra::detail::fit\n")


def rays_for(facts, error):
    return next(n * n for n in range(2, 257) if n == 256 or rays_error(facts, n * n) <= error)


def choices(row, model, error):
    """By the model and by measured times, milliseconds with set-up for one frame. Times of rays are lines through two numbers of
    rays, or through zero."""
    facts, measured = row["facts"], row["measured"]
    n, setup = rays_for(facts, error), facts["edges"] * model.hierarchy
    predicted = {"silhouette": model.of_silhouette(facts) + setup, "rays": model.of_rays(facts, n) + setup,
                 "reference": model.of_reference(facts, n)}
    few, many = measured["rays-16"]["frame_ms"], measured["rays-144"]["frame_ms"]
    once = max(0, measured["silhouette"]["setup_ms"])
    return predicted, {"silhouette": measured["silhouette"]["frame_ms"] + once,
                       "rays": max(few * n / 144, few + (many - few) * (n - 16) / 128) + once,
                       "reference": measured["reference-16"]["frame_ms"] * n / 16}


def regrets(rows):
    lines = ["", "What the choice costs beside the cheapest of the three, by measured times and set-up for one frame. Each scene is judged by a",
             "model that was fitted without it.", "",
             "| error | scenes by `silhouette`, `rays`, `reference` | over 1.3 times | the worst scenes | beside `silhouette` at most |",
             "|---|---|---|---|---|"]
    without = {name: Model({other: row for other, row in rows.items() if other != name}) for name in rows}
    for error in (.05, .02, .01, .005, .002):
        chosen, worst, beside = {"silhouette": 0, "rays": 0, "reference": 0}, [], []
        for name, row in rows.items():
            predicted, true = choices(row, without[name], error)
            choice = min(predicted, key=predicted.get)
            chosen[choice] += 1
            worst.append((true[choice] / min(true.values()), name))
            beside.append(true[choice] / true["silhouette"])
        worst.sort(reverse=True)
        lines.append(f"| {error} | {', '.join(str(c) for c in chosen.values())} | {sum(r > 1.3 for r, _ in worst)} of {len(worst)} | "
                     + ", ".join(f"{name} {r:.2f}" for r, name in worst[:3] if r > 1.005) + f" | {max(beside):.2f} |")
    return "\n".join(lines)


def residuals_of(rows, model):
    lines = ["Milliseconds of processor time at 320×240, halved for two cores, and RMSE; each beside what the model says.\n",
             "| scene | edges | `silhouette` | | `reference`, 16 | | `rays`, 16 | | `rays`, 144 | | RMSE, 16 | | RMSE, 144 | |",
             "|" + "---|" * 14]
    predictions = {"silhouette": model.of_silhouette, "reference-16": lambda f: model.of_reference(f, 16),
                   "rays-16": lambda f: model.of_rays(f, 16), "rays-144": lambda f: model.of_rays(f, 144)}
    off = {"time of " + name: [] for name in predictions} | {"RMSE of 16 rays": [], "RMSE of 144 rays": []}
    for name, row in rows.items():
        line = f"| {name} | {row['facts']['penumbra']['edges']:.1f} "
        for setting, predict in predictions.items():
            measured, value = row["measured"][setting]["frame_ms"], predict(row["facts"]) * 1e-6
            line += f"| {measured:.1f} | {value:.1f} "
            off["time of " + setting].append(abs(math.log(value / max(1.0, measured))))
        for samples, setting in ((16, "reference-16"), (144, "rays-144")):
            measured, value = row["measured"][setting]["rmse"], rays_error(row["facts"], samples)
            line += f"| {measured:.4f} | {value:.4f} "
            off[f"RMSE of {samples} rays"].append(abs(math.log(value / measured)))
        lines.append(line + "|")
    lines += ["", "The model is off by a factor of", "", "| | median | nine of ten | at most |", "|---|---|---|---|"]
    for what, values in off.items():
        values.sort()
        parts = [math.exp(values[k]) for k in (len(values) // 2, len(values) * 9 // 10, -1)]
        lines.append(f"| {what} | " + " | ".join(f"{part:.2f}" for part in parts) + " |")
    return "\n".join(lines)


if __name__ == "__main__":
    command, paths = sys.argv[1], sys.argv[2:]
    if command == "rows":
        measure_rows(paths[0], Path(paths[1]), paths[2:])
    elif command == "facts":
        ask_again(paths[0], Path(paths[1]))
    elif command == "fit":
        fit(Path(paths[0]), Path(paths[1]), Path(paths[2]))
    else:
        write_example(paths[0], Path(paths[1]))
