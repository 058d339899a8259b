"""The planner's model of times and errors: measures rows, fits constants to them, says how far the fit is off.

  plan_model.py rows PENUMBRA ROWS.json [CASE...]   measures all cases or those named, and replaces their rows
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
RAYS = {"reference": 16, "rays": 144}
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


def measure(penumbra, scene, folder):
    plan = json.loads(subprocess.run([penumbra, "plan", str(scene), *SIZE, "--json"], check=True, capture_output=True).stdout)
    row = {"facts": plan["lights"][0]["facts"], "methods": {}}
    none_frame, none_first = frame_and_first(penumbra, scene, ["--method", "none"], folder / "none.exr")
    for method in ["silhouette", "reference", "rays"]:
        words = ["--method", method] + (["--samples", str(RAYS[method])] if method in RAYS else [])
        frame, first = frame_and_first(penumbra, scene, words, folder / f"{method}.exr")
        row["methods"][method] = {"frame_ms": round(frame - none_frame, 2),
                                  "setup_ms": round(first - none_first - (frame - none_frame), 2)}
    for method in RAYS:
        command = [penumbra, "compare", str(folder / f"{method}.exr"), str(folder / "silhouette.exr"), "--json"]
        figures = json.loads(subprocess.run(command, check=True, capture_output=True).stdout)
        row["methods"][method] |= {"samples": RAYS[method], "rmse": round(figures["penumbra"]["rmse"], 5)}
    return row


def measure_rows(penumbra, path, names):
    rows = json.loads(path.read_text()) if path.exists() else {}
    with tempfile.TemporaryDirectory() as temporary:
        folder = Path(temporary)
        cases = dict(write_soup(folder, *soup) for soup in SOUPS)
        cases |= {name: TOP / f"data/scenes/{name}.json" for name in SCENES}
        cases |= dict([write_fan(folder, 4000, .5), write_fan(folder, 300, 1)])
        for name in names or cases:
            rows[name] = measure(penumbra, cases[name], folder)
            path.write_text(json.dumps(dict(sorted(rows.items())), indent=1) + "\n")
            print(name, json.dumps(rows[name]["methods"]), flush=True)


def least_squares(features, values):
    """Constants of at least 0 with the least sum of squared relative errors: by one after the other, over and over."""
    scaled = [[f / v for f in row] for row, v in zip(features, values)]
    constants = [0.0] * len(features[0])
    for _ in range(20000):
        for k in range(len(constants)):
            norm = sum(row[k] ** 2 for row in scaled)
            if norm == 0:
                continue
            slope = sum(row[k] * (1 - sum(c * f for c, f in zip(constants, row))) for row in scaled)
            constants[k] = max(0.0, constants[k] + slope / norm)
    return constants


def numbers(row):
    facts = row["facts"]
    reached = facts["receivers"] - facts["dark_receivers"]
    parts = [facts[part] for part in ("lit", "penumbra", "hidden")]
    mean = {key: sum(part["share"] * part[key] for part in parts) for key in ("edges", "merged_edges", "boxes")}
    # Receivers that certificates leave open: the penumbra, and others before which edges lie.
    mean["open"] = reached * (facts["penumbra"]["share"] + sum(
        facts[part]["share"] * min(1, facts[part]["edges"]) for part in ("lit", "hidden")))
    return facts, reached, mean


def silhouette_features(row):
    facts, reached, mean = numbers(row)
    return [reached, facts["edges"], mean["open"], reached * mean["edges"], reached * mean["merged_edges"]]


def reference_features(row):
    facts, reached, mean = numbers(row)
    n = row["methods"]["reference"]["samples"] * reached
    return [n, n * math.log2(1 + facts["faces"]), n * mean["boxes"]]


def ray_ns(row, ray):
    facts = row["facts"]
    return ray[0] + ray[1] * math.log2(1 + facts["faces"]) + ray[2] * facts["penumbra"]["boxes"]


def certify_features(row):
    facts, reached, mean = numbers(row)
    return [reached, facts["edges"], reached * mean["edges"]]


def stratified(row, samples, strata, power):
    facts = row["facts"]
    chance = facts["variance"] / samples
    by_strata = strata * max(1.0, facts["penumbra"]["edges"]) ** power / samples ** 1.5
    return math.sqrt(chance * by_strata / (chance + by_strata))


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


def fit(path, header, document):
    rows = {name: row for name, row in json.loads(path.read_text()).items() if row["facts"]["penumbra"]["share"] > 0}
    frames = lambda method: [max(1.0, row["methods"][method]["frame_ms"]) * 1e6 for row in rows.values()]
    silhouette = least_squares([silhouette_features(row) for row in rows.values()], frames("silhouette"))
    ray = least_squares([reference_features(row) for row in rows.values()], frames("reference"))
    # Rays cost the same each whichever method sends them.
    left, kept = [], []
    for row, time in zip(rows.values(), frames("rays")):
        rest = time - numbers(row)[2]["open"] * row["methods"]["rays"]["samples"] * ray_ns(row, ray)
        left.append(max(rest, .1 * time))
        kept.append(certify_features(row))
    certify = least_squares(kept, left)
    setups = [(row["facts"]["edges"], row["methods"]["silhouette"]["setup_ms"] * 1e6) for row in rows.values()]
    setups = [(edges, time) for edges, time in setups if time > 1e7]
    hierarchy = least_squares([[edges] for edges, _ in setups], [time for _, time in setups])[0] if setups else 0.0
    errors = [(row, m["samples"], m["rmse"]) for row in rows.values() for m in row["methods"].values() if "rmse" in m]
    distance = lambda s, p: sum(math.log(stratified(row, n, s, p) / e) ** 2 for row, n, e in errors if e > 0)
    strata, power = min(((.01 * s, .02 * p) for s in range(2, 60) for p in range(0, 50)), key=lambda c: distance(*c))
    write_header(header, silhouette, certify, ray, hierarchy, strata, power)
    residuals = residuals_of(rows, silhouette, certify, ray, strata, power)
    print(residuals)
    replace_block(document, "<!-- residuals -->", residuals)


def write_header(path, silhouette, certify, ray, hierarchy, strata, power):
    names = ["Receiver", "BandEdge", "Open", "Edge", "Merged"]
    lines = [f"inline constexpr double kSilhouette{name} = {value:.4g};" for name, value in zip(names, silhouette)]
    lines += [f"inline constexpr double kCertify{name} = {value:.4g};"
              for name, value in zip(["Receiver", "BandEdge", "Edge"], certify)]
    lines += [f"inline constexpr double kRay{name} = {value:.4g};" for name, value in zip(["", "LogFaces", "Box"], ray)]
    lines += [f"inline constexpr double kHierarchyEdge = {hierarchy:.4g};", "// RMSE.",
              f"inline constexpr double kStrata = {strata:.4g};", f"inline constexpr double kStrataPower = {power:.4g};"]
    path.write_text("// Constants of the planner's model. Made by `./run plan-model` from data/plan/rows.json: do not edit.\n"
                    "#pragma once\n\nnamespace penumbra::detail::fit {\n\n// Nanoseconds on two cores.\n"
                    + "\n".join(lines) + "\n\n}  // namespace penumbra::detail::fit\n")


def residuals_of(rows, silhouette, certify, ray, strata, power):
    lines = ["Milliseconds of processor time at 320×240, halved for two cores; RMSE of 16 and of 144 rays.\n",
             "| scene | edges | `silhouette` | model | `rays`, 144 | model | `reference`, 16 | model | RMSE, 16 | model | RMSE, 144 "
             "| model |", "|---|---|---|---|---|---|---|---|---|---|---|---|"]
    off = {"`silhouette`": [], "`rays`": [], "`reference`": [], "RMSE": []}
    for name, row in rows.items():
        cost = lambda constants, features: sum(c * f for c, f in zip(constants, features)) * 1e-6
        sent = numbers(row)[2]["open"] * row["methods"]["rays"]["samples"] * ray_ns(row, ray) * 1e-6
        model = {"silhouette": cost(silhouette, silhouette_features(row)),
                 "rays": cost(certify, certify_features(row)) + sent,
                 "reference": cost(ray, reference_features(row))}
        line = f"| {name} | {row['facts']['penumbra']['edges']:.1f} "
        for method, value in model.items():
            measured = row["methods"][method]["frame_ms"]
            line += f"| {measured:.1f} | {value:.1f} "
            off[f"`{method}`"].append(abs(math.log(value / max(1.0, measured))))
        for method in RAYS:
            m = row["methods"][method]
            value = stratified(row, m["samples"], strata, power)
            line += f"| {m['rmse']:.4f} | {value:.4f} "
            off["RMSE"].append(abs(math.log(value / m["rmse"])) if m["rmse"] > 0 else 0)
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
    elif command == "fit":
        fit(Path(paths[0]), Path(paths[1]), Path(paths[2]))
    else:
        write_example(paths[0], Path(paths[1]))
