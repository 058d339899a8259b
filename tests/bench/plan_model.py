"""The planner's model of times and errors: fits constants to measured rows, says how far the fit is off, and how good plans are.

  plan_model.py fit ROWS.jsonl CALIBRATION.json HEADER DOCUMENT   writes the constants, and how far they are off into the document
  plan_model.py check FOOLISH.jsonl RANDOM.jsonl DOCUMENT         writes what plans cost beside the best method into the document
  plan_model.py example PENUMBRA DOCUMENT                         writes what `penumbra plan` says of the document's scene into it

Rows are those of penumbra_plan_bench (tests/bench/plan): for each scene the facts of its plan, and for each method milliseconds of the
processor's time on one thread, halved for two cores, and the RMSE of V over the penumbra by rays in double without offset.
"""
import json
import math
import subprocess
import sys
from pathlib import Path

TOP = Path(__file__).resolve().parents[2]
PARTS = ("lit", "penumbra", "hidden")
FEW_EDGES, EDGES_OF_RAY = 20, 24  # as cost_model.cpp


def read_rows(path):
    rows = [json.loads(line) for line in path.read_text().splitlines()]
    return {row["name"]: row for row in sorted(rows, key=lambda row: row["name"])}


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
    return sum(facts[part]["share"] * number(facts[part]) for part in PARTS)


def reached(facts):
    return facts["receivers"] - facts["dark_receivers"]


def silhouette_features(facts, few=1.0, many=1.0):
    """`many`: by how much another number of rows changes the time of areas of many edges."""
    area = lambda part, term: (many if part["edges"] > FEW_EDGES else few) * term
    return [reached(facts), facts["edges"], reached(facts) * mean(facts, lambda p: area(p, p["merged_edges"])),
            reached(facts) * mean(facts, lambda p: area(p, math.sqrt(p["edges"]))),
            reached(facts) * mean(facts, lambda p: area(p, p["edge_length"])), reached(facts) * mean(facts, lambda p: p["boxes"])]


def ray_features(facts, part):
    return [1, math.log2(1 + facts["faces"]), math.sqrt(part["boxes"]), math.sqrt(part["edges"]), math.sqrt(part["boxes"] * part["edges"])]


def reference_features(facts, samples):
    parts = [facts[part] for part in PARTS]
    sums = [sum(part["share"] * f for part, f in zip(parts, fs)) for fs in zip(*(ray_features(facts, p) for p in parts))]
    return [samples * reached(facts) * f for f in sums]


def rays_error(facts, samples):
    chance, boundary = facts["variance"] / samples, facts["boundary"] / samples ** 1.5
    return math.sqrt(chance * boundary / (chance + boundary))


def rays_for(facts, error):
    return next(n * n for n in range(2, 257) if n == 256 or rays_error(facts, n * n) <= error)


class Model:
    """The constants, and what they say of a scene's facts, nanoseconds. As render/plan/cost_model.cpp."""

    def __init__(self, rows):
        facts = [row["facts"] for row in rows.values()]
        ns = lambda name: [max(.2, row["measured"][name]["frame_ms"]) * 1e6 for row in rows.values()]
        self.silhouette = fit_constants([silhouette_features(f) for f in facts], ns("silhouette"))
        self.rows = {64: 1.0} | {count: self.time_of_rows(facts, ns(f"silhouette-{count}")) for count in (32, 16)}
        self.ray = fit_constants([reference_features(f, n) for n in (16, 144) for f in facts], ns("reference-16") + ns("reference-144"))
        self.rays = fit_constants(
            [self.rays_features(f, n, up_to) for n in (16, 144) for up_to in (0, n // 4) for f in facts],
            [t for n in (16, 144) for name in ("rays", "areas") for t in ns(f"{name}-{n}")])
        setups = [(f["edges"], row["measured"]["silhouette"]["setup_ms"] * 1e6) for f, row in zip(facts, rows.values())]
        setups = [(edges, time) for edges, time in setups if time > 5e6]
        self.hierarchy = fit_constants([[edges] for edges, _ in setups], [time for _, time in setups])[0]
        self.errors = self.errors_of_silhouette(rows)

    def time_of_rows(self, facts, times):
        loss = lambda many: sum(math.log(total(self.silhouette, silhouette_features(f, 1, many)) / t) ** 2 for f, t in zip(facts, times))
        return min((k / 100 for k in range(20, 121)), key=loss)

    @staticmethod
    def errors_of_silhouette(rows):
        """What nineteen of twenty scenes keep."""
        def most(values):
            return sorted(values)[min(len(values) - 1, math.ceil(.95 * len(values)) - 1)] if values else 1.0
        sort = lambda many, name: [row["measured"][name]["rmse"] for row in rows.values()
                                   if "rmse" in row["measured"][name] and (row["facts"]["penumbra"]["edges"] > FEW_EDGES) == many]
        return {"few": most(sort(False, "silhouette"))} | {
            count: most(sort(True, "silhouette" if count == 64 else f"silhouette-{count}")) for count in (64, 32, 16)}

    def area_ns(self, part):
        return self.silhouette[2] * part["merged_edges"] + self.silhouette[3] * math.sqrt(part["edges"]) + self.silhouette[4] * part["edge_length"]

    def open_ns(self, facts, samples, up_to, name):
        part = facts[name]
        share = 1 if name == "penumbra" else min(1, part["edges"])
        traced = samples * total(self.ray, ray_features(facts, part))
        few = min(1, up_to / part["edges"]) if part["edges"] > 0 else float(up_to > 0)
        return reached(facts) * part["share"] * share * (few * min(few * self.area_ns(part), traced) + (1 - few) * traced)

    def rays_features(self, facts, samples, up_to):
        return [reached(facts), facts["edges"], reached(facts) * mean(facts, lambda p: math.sqrt(p["edges"])),
                reached(facts) * mean(facts, lambda p: min(p["edges"], EDGES_OF_RAY * samples)),
                reached(facts) * mean(facts, lambda p: p["boxes"]), self.open_ns(facts, samples, up_to, "penumbra"),
                self.open_ns(facts, samples, up_to, "hidden") + self.open_ns(facts, samples, up_to, "lit")]

    def of_silhouette(self, facts, rows=64):
        return total(self.silhouette, silhouette_features(facts, 1, self.rows[rows]))

    def of_reference(self, facts, samples):
        return total(self.ray, reference_features(facts, samples))

    def of_rays(self, facts, samples, up_to):
        return total(self.rays, self.rays_features(facts, samples, up_to))

    def error_of_silhouette(self, facts, rows=64):
        return self.errors[rows if facts["penumbra"]["edges"] > FEW_EDGES else "few"]


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


def fit(path, calibration, header, document):
    rows = read_rows(path)
    model = Model(rows)
    write_header(header, model, json.loads(calibration.read_text()))
    replace_block(document, "<!-- residuals -->", residuals_of(rows, model))


def write_header(path, model, calibration):
    names = [("Silhouette", ["Receiver", "BandEdge", "Merged", "RootOfEdges", "Length", "Box"], model.silhouette),
             ("Ray", ["", "LogFaces", "RootOfBoxes", "RootOfEdges", "RootOfBoth"], model.ray),
             ("Rays", ["Receiver", "BandEdge", "RootOfEdges", "Edge", "Box", "OpenPenumbra", "OpenRest"], model.rays),
             ("Hierarchy", ["Edge"], [model.hierarchy])]
    line = lambda name, value: f"inline constexpr double k{name} = {value:.4g};"
    lines = ["// Nanoseconds on two cores; kRaysOpen..., kTimeOf...: factors."]
    lines += [line(group + name, value) for group, members, values in names for name, value in zip(members, values)]
    lines += [line(f"TimeOf{count}Rows", model.rows[count]) for count in (16, 32)]
    lines += ["// RMSE of V over the penumbra."]
    lines += [line("ErrorOfFew", model.errors["few"])] + [line(f"ErrorOfMany{count}", model.errors[count]) for count in (16, 32, 64)]
    lines += ["// Milliseconds of `penumbra plan --calibrate` on that machine."]
    lines += [line("CalibrationSilhouette", calibration["silhouette_ms"]), line("CalibrationReference", calibration["reference_ms"])]
    path.write_text("// Constants of the planner's model. Made by `./run plan-model` from data/plan/rows.jsonl: do not edit.\n"
                    "#pragma once\n\nnamespace penumbra::detail::fit {\n\n" + "\n".join(lines) + "\n\n}  // namespace penumbra::detail::fit\n")


def off_table(off):
    lines = ["| | median | nine of ten | at most |", "|---|---|---|---|"]
    for what, values in off.items():
        values = sorted(values)
        parts = [math.exp(values[k]) for k in (len(values) // 2, len(values) * 9 // 10, -1)]
        lines.append(f"| {what} | " + " | ".join(f"{part:.2f}" for part in parts) + " |")
    return lines


def residuals_of(rows, model):
    predictions = {"silhouette": lambda f: model.of_silhouette(f), "reference-16": lambda f: model.of_reference(f, 16),
                   "rays-16": lambda f: model.of_rays(f, 16, 0), "rays-144": lambda f: model.of_rays(f, 144, 0),
                   "areas-144": lambda f: model.of_rays(f, 144, 36)}
    lines = ["Milliseconds of processor time at 320×240, halved for two cores, and RMSE over the penumbra by rays in double; each beside what",
             "the model says. `areas`: `rays --areas-up-to 36`.", "",
             "| scene | edges | " + " | | ".join(f"`{name}`" for name in predictions) + " | | RMSE, `silhouette` | | RMSE, 16 rays | | RMSE, 144 rays | |",
             "|" + "---|" * (2 + 2 * len(predictions) + 6)]
    off = {"time of " + name: [] for name in predictions} | {"RMSE of 16 rays": [], "RMSE of 144 rays": []}
    above = 0
    for name, row in rows.items():
        line = f"| {name} | {row['facts']['penumbra']['edges']:.1f} "
        for setting, predict in predictions.items():
            measured, value = row["measured"][setting]["frame_ms"], predict(row["facts"]) * 1e-6
            line += f"| {measured:.1f} | {value:.1f} "
            off["time of " + setting].append(abs(math.log(value / max(.2, measured))))
        measured, value = row["measured"]["silhouette"]["rmse"], model.error_of_silhouette(row["facts"])
        above += measured > value
        line += f"| {measured:.5f} | {value:.5f} "
        for samples in (16, 144):
            measured, value = row["measured"][f"reference-{samples}"]["rmse"], rays_error(row["facts"], samples)
            line += f"| {measured:.4f} | {value:.4f} "
            off[f"RMSE of {samples} rays"].append(abs(math.log(value / measured)))
        lines.append(line + "|")
    lines += ["", f"The RMSE of `silhouette` is above the model's in {above} of {len(rows)} scenes. The model is off by a factor of", ""]
    lines += off_table(off)
    return "\n".join(lines)


def time_for(row, method, error):
    """Milliseconds, set-up included, that a method takes for the least number of rays that keeps the error: between measured numbers
    of rays 1/error is a power of n, and time a line. None where none is known to keep it."""
    measured = row["measured"]
    points = [(n, measured[f"{method}-{n}"]) for n in (16, 64, 256)]
    if points[0][1]["rmse"] <= error:
        return points[0][1]["frame_ms"] + max(0, points[0][1]["setup_ms"])
    low, high = next(((a, b) for a, b in zip(points, points[1:]) if b[1]["rmse"] <= error), (points[1], points[2]))
    slope = math.log(low[1]["rmse"] / high[1]["rmse"]) / math.log(high[0] / low[0])
    if slope <= 0:
        return None
    n = low[0] * (low[1]["rmse"] / error) ** (1 / slope)
    if n > 4096:
        return None
    return low[1]["frame_ms"] + (high[1]["frame_ms"] - low[1]["frame_ms"]) * (n - low[0]) / (high[0] - low[0]) + max(0, low[1]["setup_ms"])


def best_time(row, error):
    """Of all methods that keep it, (milliseconds, name)."""
    whole = lambda name: row["measured"][name]["frame_ms"] + max(0, row["measured"][name]["setup_ms"])
    all_of = [(whole(name), name) for name in ("silhouette", "silhouette-32", "silhouette-16") if row["measured"][name]["rmse"] <= error]
    all_of += [(time, method) for method in ("rays", "areas", "reference") if (time := time_for(row, method, error)) is not None]
    return min(all_of, default=(None, None))


def judged_plans(rows):
    """(scene, what auto did, its time beside the best, whether the error is kept, whether some method keeps it)"""
    out = []
    for name, row in rows.items():
        for done in row.get("auto", []):
            if "rmse" not in done or row["judged_pixels"] < 50:
                continue
            best, by = best_time(row, done["budget"])
            time = done["frame_ms"] + max(0, done["setup_ms"])
            said = done["reason"] not in ("most-accurate", "fastest", "within-time")
            out.append({"scene": name, "budget": done["budget"], "method": done["method"], "time": time, "best": best, "by": by,
                        "ratio": time / best if best else None, "kept": done["low"] <= done["budget"],
                        "kept_by_estimate": done["rmse"] <= done["budget"], "rmse": done["rmse"], "said": said})
    return out


def summary(plans):
    met = [p for p in plans if p["best"]]
    share = lambda some, of: f"{len(some)} of {len(of)}"
    return [f"- The error is kept in {share([p for p in met if p['kept_by_estimate']], met)}; "
            f"in {share([p for p in met if p['kept']], met)} by the lower end of the 95% interval.",
            f"- The time is within 1.25 times that of the fastest method that keeps the error in {share([p for p in met if p['ratio'] <= 1.25], met)}, "
            f"within 1.3 times in {share([p for p in met if p['ratio'] <= 1.3], met)}, or within half a millisecond of it in "
            f"{share([p for p in met if p['ratio'] <= 1.25 or p['time'] - p['best'] <= .5], met)}.",
            f"- No method was seen to keep the error in {len(plans) - len(met)}; the plan says so in "
            f"{len([p for p in plans if not p['best'] and not p['said']])} of these."]


def worst(plans, count):
    lines = ["| scene | error | plan | ms | best | ms | times |", "|---|---|---|---|---|---|---|"]
    for p in sorted((p for p in plans if p["best"]), key=lambda p: -p["ratio"])[:count]:
        lines.append(f"| {p['scene']} | {p['budget']} | {p['method']} | {p['time']:.1f} | {p['by']} | {p['best']:.1f} | {p['ratio']:.2f} |")
    return lines


def check(foolish, chance, document):
    lines = []
    if foolish.exists():
        plans = judged_plans(read_rows(foolish))
        lines += [f"Scenes on which some method is foolish, {len(plans)} plans for errors of .05 to .002; set-up and planning included:", ""]
        lines += summary(plans) + [""] + worst(plans, 8) + [""]
    if chance.exists():
        plans = judged_plans(read_rows(chance))
        lines += [f"Scenes by chance, {len(plans)} that have a penumbra, one error each of .05 to .003:", ""] + summary(plans) + [""] + worst(plans, 8)
    replace_block(document, "<!-- check -->", "\n".join(lines))
    print("\n".join(lines))


if __name__ == "__main__":
    command, paths = sys.argv[1], [Path(path) for path in sys.argv[2:]]
    {"fit": fit, "check": check, "example": write_example}[command](*paths)
