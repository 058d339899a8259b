"""The planner's model of times and errors: fits constants to measured rows, says how far the fit is off, and how good plans are.

  plan_model.py fit ROWS.jsonl HEADER DOCUMENT   writes the constants, and how far they are off into the document
  plan_model.py check RANDOM.jsonl [FOOLISH.jsonl]   says what plans cost beside the fastest method
  plan_model.py errors ERRORS.jsonl [DOCUMENT]       says, there too, how often errors that are asked for are kept
  plan_model.py checked RANDOM.jsonl DOCUMENT        writes that into the document
  plan_model.py example PENUMBRA DOCUMENT            writes what `penumbra plan` says of the document's scene into it

Rows are those of penumbra_plan_bench (tests/bench/plan): for each scene the facts of its plan, and for each method milliseconds of the
processor's time on one thread, halved for two cores, and the RMSE of V over the penumbra by rays in double without offset; of rays also
the RMSE that the plan says is kept nineteen times of twenty (kept).
"""
import collections
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


def silhouette_features(facts):
    return [reached(facts), facts["edges"], facts["band_edges"], reached(facts) * mean(facts, lambda p: p["merged_edges"]),
            reached(facts) * mean(facts, lambda p: math.sqrt(p["edges"])),
            reached(facts) * mean(facts, lambda p: p["edge_length"]), reached(facts) * mean(facts, lambda p: p["boxes"])]


def merging_features(facts):
    return [facts["edges_of_method"], facts["edges_of_method"] ** 1.5]


def ray_features(facts, part, samples):
    """Of a receiver with so many rays."""
    both = math.sqrt(part["boxes"] * part["edges"])
    return [1, both] + [samples * feature for feature in (1, math.log2(1 + facts["faces"]), math.sqrt(part["boxes"]), math.sqrt(part["edges"]), both)]


def reference_features(facts, samples):
    parts = [facts[part] for part in PARTS]
    sums = [sum(part["share"] * f for part, f in zip(parts, fs)) for fs in zip(*(ray_features(facts, p, samples) for p in parts))]
    return [reached(facts) * f for f in sums]


def few_of(part, up_to):
    """Of a part's receivers, those that see few edges: their share, and that of the part's edges that these see."""
    each = part["edges_each"]
    if up_to <= 0:
        return 0, 0
    if not each:
        return (1, 1) if part["edges"] <= up_to else (0, 0)
    few = [edges for edges in each if edges <= up_to]
    return len(few) / len(each), sum(few) / sum(each) if sum(each) > 0 else 1


class Model:
    """The constants, and what they say of a scene's facts, nanoseconds. As render/plan/cost_model.cpp."""

    def __init__(self, rows):
        facts = [row["facts"] for row in rows.values()]
        # (facts, rays, nanoseconds) of all rows of a method
        of = lambda method: [(row["facts"], int(name.partition("-")[2] or 0), max(.2, measured["frame_ms"]) * 1e6)
                             for row in rows.values() for name, measured in row["measured"].items() if name.partition("-")[0] == method]
        times = lambda some: [time for _, _, time in some]
        by_areas, by_reference, by_rays, by_both = (of(name) for name in ("silhouette", "reference", "rays", "areas"))
        self.silhouette = fit_constants([silhouette_features(f) for f, _, _ in by_areas], times(by_areas))
        self.ray = fit_constants([reference_features(f, n) for f, n, _ in by_reference], times(by_reference))
        self.rays = fit_constants([self.rays_features(f, n, 0) for f, n, _ in by_rays] +
                                  [self.rays_features(f, n, n // 4) for f, n, _ in by_both], times(by_rays) + times(by_both))
        least = lambda row, method: min(m["setup_ms"] for name, m in row["measured"].items() if name.partition("-")[0] == method) * 1e6
        many = [row for row in rows.values() if row["facts"]["edges_of_method"] > 8000 and least(row, "rays") > 1e6]
        self.hierarchy = fit_constants([[row["facts"]["edges_of_method"]] for row in many], [least(row, "rays") for row in many])[0]
        merged = [row for row in many if least(row, "silhouette") > 1.1 * least(row, "rays")]
        self.merging = fit_constants([merging_features(row["facts"]) for row in merged],
                                     [least(row, "silhouette") - least(row, "rays") for row in merged])
        self.errors = self.errors_of_silhouette(rows)

    @staticmethod
    def errors_of_silhouette(rows):
        """What nineteen of twenty scenes keep."""
        def most(values):
            return sorted(values)[min(len(values) - 1, math.ceil(.95 * len(values)) - 1)] if values else 1.0
        sort = lambda many: [row["measured"]["silhouette"]["rmse"] for row in rows.values()
                             if "rmse" in row["measured"]["silhouette"] and (row["facts"]["penumbra"]["edges"] > FEW_EDGES) == many]
        return {"few": most(sort(False)), "many": most(sort(True))}

    def area_ns(self, part):
        return self.silhouette[3] * part["merged_edges"] + self.silhouette[4] * math.sqrt(part["edges"]) + self.silhouette[5] * part["edge_length"]

    def open_ns(self, facts, samples, up_to, name):
        part = facts[name]
        share = 1 if name == "penumbra" else min(1, part["edges"])
        few, of_edges = few_of(part, up_to)
        return reached(facts) * part["share"] * share * (
            of_edges * self.area_ns(part) + (1 - few) * total(self.ray, ray_features(facts, part, samples)))

    def rays_features(self, facts, samples, up_to):
        return [reached(facts), facts["edges"], facts["band_edges"], reached(facts) * mean(facts, lambda p: math.sqrt(p["edges"])),
                reached(facts) * mean(facts, lambda p: min(p["edges"], EDGES_OF_RAY * samples)),
                reached(facts) * mean(facts, lambda p: p["boxes"]), self.open_ns(facts, samples, up_to, "penumbra"),
                self.open_ns(facts, samples, up_to, "hidden") + self.open_ns(facts, samples, up_to, "lit")]

    def setup(self, facts, merged):
        return self.hierarchy * facts["edges_of_method"] + (total(self.merging, merging_features(facts)) if merged else 0)

    def of_silhouette(self, facts):
        return total(self.silhouette, silhouette_features(facts))

    def of_reference(self, facts, samples):
        return total(self.ray, reference_features(facts, samples))

    def of_rays(self, facts, samples, up_to):
        return total(self.rays, self.rays_features(facts, samples, up_to))

    def error_of_silhouette(self, facts):
        return self.errors["many" if facts["penumbra"]["edges"] > FEW_EDGES else "few"]


def replace_block(document, begin, text):
    """What stands between the line that begins so and the next end mark."""
    before, mark, after = document.read_text().partition(begin)
    if not mark:
        sys.exit(f"{document}: no line {begin}")
    line, _, after = after.partition("\n")
    after = after[after.index("<!-- end -->"):]
    document.write_text(f"{before}{begin}{line}\n{text.strip()}\n{after}")


def write_example(penumbra, document):
    """What the plan of the document's scene says."""
    scene = document.read_text().partition("<!-- plan: ")[2].partition(" -->")[0]
    text = subprocess.run([penumbra, "plan", scene], check=True, capture_output=True, text=True, cwd=TOP).stdout
    replace_block(document, "<!-- plan: ", f"```text\n{text}```")


def fit(path, header, document):
    rows = read_rows(path)
    model = Model(rows)
    write_header(header, model)
    replace_block(document, "<!-- residuals -->", residuals_of(rows, model))


def write_header(path, model):
    names = [("Silhouette", ["Receiver", "CasterEdge", "BandEdge", "Merged", "RootOfEdges", "Length", "Box"], model.silhouette),
             ("Ray", ["Receiver", "ReceiverRootOfBoth", "", "LogFaces", "RootOfBoxes", "RootOfEdges", "RootOfBoth"], model.ray),
             ("Rays", ["Receiver", "CasterEdge", "BandEdge", "RootOfEdges", "Edge", "Box", "OpenPenumbra", "OpenRest"], model.rays),
             ("Hierarchy", ["Edge"], [model.hierarchy]), ("Merging", ["Edge", "EdgeTimesRoot"], model.merging)]
    line = lambda name, value: f"inline constexpr double k{name} = {value:.4g};"
    lines = ["// Nanoseconds on two cores; kRaysOpen...: factors."]
    lines += [line(group + name, value) for group, members, values in names for name, value in zip(members, values)]
    lines += ["// RMSE of V over the penumbra."]
    lines += [line("ErrorOfFew", model.errors["few"]), line("ErrorOfMany", model.errors["many"])]
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
    shown = ("silhouette", "reference-16", "rays-16", "rays-144", "areas-144")
    lines = ["Milliseconds of processor time at 320×240, halved for two cores, and RMSE over the penumbra by rays in double; each beside what",
             "the model says. `areas`: `rays --areas-up-to 36`. The rows by chance are in the second table alone.", "",
             "| scene | edges | " + " | | ".join(f"`{name}`" for name in shown) + " | | RMSE, `silhouette` | | RMSE, 16 rays | | RMSE, 144 rays | |",
             "|" + "---|" * (2 + 2 * len(shown) + 6)]
    off = {}
    judged, above = collections.Counter(), collections.Counter()
    for name, row in rows.items():
        facts, cells = row["facts"], {}
        for setting, measured in row["measured"].items():
            method, _, number = setting.partition("-")
            samples = int(number or 0)
            predicted = {"silhouette": lambda: model.of_silhouette(facts), "reference": lambda: model.of_reference(facts, samples),
                         "rays": lambda: model.of_rays(facts, samples, 0), "areas": lambda: model.of_rays(facts, samples, samples // 4)}[method]() * 1e-6
            off.setdefault(f"time of `{method}`", []).append(abs(math.log(predicted / max(.2, measured["frame_ms"]))))
            cells[setting] = f"{measured['frame_ms']:.1f} | {predicted:.1f}"
            if "rmse" not in measured:
                continue
            error = (model.error_of_silhouette(facts) if method == "silhouette" else
                     math.hypot(model.error_of_silhouette(facts) if method == "areas" else 0, row["kept"][setting]))
            judged[method] += 1
            above[method] += measured["rmse"] > error
            if method == "reference":
                off.setdefault("RMSE of rays", []).append(abs(math.log(error / measured["rmse"])))
                cells[f"RMSE {samples}"] = f"{measured['rmse']:.4f} | {error:.4f}"
            if method == "silhouette":
                cells["RMSE 0"] = f"{measured['rmse']:.5f} | {error:.5f}"
        if not name.startswith("random-"):
            columns = [cells[setting] for setting in (*shown, "RMSE 0", "RMSE 16", "RMSE 144")]
            lines.append(f"| {name} | {facts['penumbra']['edges']:.1f} | " + " | ".join(columns) + " |")
    lines += ["", "The RMSE is above the model's in " + ", ".join(f"{above[m]} of {judged[m]} by `{m}`" for m in judged) + ". The model is off by a factor of", ""]
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
    least = 1e-6  # as rows are rounded: areas alone have no error that is seen
    slope = math.log(max(least, low[1]["rmse"]) / max(least, high[1]["rmse"])) / math.log(high[0] / low[0])
    if slope <= 0:
        return None
    n = low[0] * (low[1]["rmse"] / error) ** (1 / slope)
    if n > 4096:
        return None
    return low[1]["frame_ms"] + (high[1]["frame_ms"] - low[1]["frame_ms"]) * (n - low[0]) / (high[0] - low[0]) + max(0, low[1]["setup_ms"])


def best_time(row, error):
    """Of all methods that keep it, (milliseconds, name)."""
    whole = lambda name: row["measured"][name]["frame_ms"] + max(0, row["measured"][name]["setup_ms"])
    all_of = [(whole("silhouette"), "silhouette")] if row["measured"]["silhouette"]["rmse"] <= error else []
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
    lines = [f"- The error is kept in {share([p for p in met if p['kept_by_estimate']], met)}; "
            f"in {share([p for p in met if p['kept']], met)} by the lower end of the 95% interval.",
            f"- The time is within 1.25 times that of the fastest method that keeps the error in {share([p for p in met if p['ratio'] <= 1.25], met)}, "
            f"within 1.3 times in {share([p for p in met if p['ratio'] <= 1.3], met)}, or within half a millisecond of it in "
            f"{share([p for p in met if p['ratio'] <= 1.25 or p['time'] - p['best'] <= .5], met)}."]
    if len(met) < len(plans):
        lines.append(f"- No method was seen to keep the error in {len(plans) - len(met)}; the plan says so in "
                     f"{len([p for p in plans if not p['best'] and not p['said']])} of these.")
    return lines


def worst(plans, count):
    lines = ["| scene | error | plan | ms | best | ms | times |", "|---|---|---|---|---|---|---|"]
    for p in sorted((p for p in plans if p["best"]), key=lambda p: -p["ratio"])[:count]:
        lines.append(f"| {p['scene']} | {p['budget']} | {p['method']} | {p['time']:.1f} | {p['by']} | {p['best']:.1f} | {p['ratio']:.2f} |")
    return lines


def said_of(rows, words):
    plans = judged_plans(rows)
    return "\n".join([f"{len(plans)} plans for {words}:", ""] + summary(plans) + [""] + worst(plans, 8))


def said_of_chance(chance):
    return said_of(read_rows(chance), "scenes by chance that have a penumbra, each for one error of .05 to .003")


def kept_errors(path):
    """How often an error that is asked for is kept, of rows without times."""
    done = [plan for row in read_rows(path).values() if row["judged_pixels"] >= 50
            for plan in row.get("auto", []) if plan["reason"] == "cheapest"]
    groups = {"all": done} | {method: [p for p in done if p["method"] == method] for method in sorted({p["method"] for p in done})}
    groups |= {f"error {budget}": [p for p in done if p["budget"] == budget] for budget in sorted({p["budget"] for p in done})}
    lines = ["| plans | kept | by the lower end of the 95% interval | RMSE over what the plan predicts: median | nine of ten | at most |", "|---|---|---|---|---|---|"]
    for name, plans in groups.items():
        ratios = sorted(p["rmse"] / p["predicted_error"] for p in plans)
        kept = [sum(p[key] <= p["budget"] for p in plans) for key in ("rmse", "low")]
        lines.append(f"| {name} | {kept[0]} of {len(plans)} | {kept[1]} of {len(plans)} | " +
                     " | ".join(f"{ratios[k]:.2f}" for k in (len(ratios) // 2, len(ratios) * 9 // 10, -1)) + " |")
    return "\n".join(lines)


def errors(path, document=None):
    print(kept_errors(path))
    if document:
        replace_block(document, "<!-- errors -->", kept_errors(path))


def check(chance, foolish=None):
    print(said_of_chance(chance))
    if foolish:
        print("\n" + said_of_foolish(foolish))


def said_of_foolish(foolish):
    return said_of(read_rows(foolish), "scenes on which some method is foolish, for errors of .05 to .002")


if __name__ == "__main__":
    command, paths = sys.argv[1], [Path(path) for path in sys.argv[2:]]
    {"fit": fit, "check": check, "errors": errors, "example": write_example,
     "checked": lambda rows, document: replace_block(document, "<!-- check -->", said_of_chance(rows)),
     "foolish": lambda rows, document: replace_block(document, "<!-- foolish -->", said_of_foolish(rows))}[command](*paths)
