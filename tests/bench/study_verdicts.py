#!/usr/bin/env python3
"""Whether studies lead to the same verdicts: study_verdicts.py STUDY.csv STUDY.csv...

A verdict is the method that the study's page names for a scene and an error, by the page's own rule (bestOf in apps/cli/study/page/tables.js).
Prints how many verdicts of each two studies are the same, and those that are not. Exits with 1 where any is not."""

import csv
import itertools
import sys

BUDGETS = [0.05, 0.02, 0.01, 0.005, 0.002, 0.001]
TIE = 1.2


def rows_of(path):
    with open(path, newline="", encoding="utf-8") as file:
        rows = [row for row in csv.DictReader(file) if row["frame_ms"] and row["rmse"]]
    for row in rows:
        for name in ("frame_ms", "over_default_low", "over_default_high", "rmse", "rmse_low", "rmse_high"):
            row[name] = float(row[name] or "nan")
        row["error"] = row["rmse"] if row["rmse_low"] > 0 else row["rmse_high"]
    return rows


def is_tied(row, best):
    return row["frame_ms"] <= TIE * best["frame_ms"] or row["over_default_low"] <= best["over_default_high"]


def verdicts_of(rows):
    methods = list(dict.fromkeys(row["method"] for row in rows))
    rank = lambda row: (row["setting"] != row["method"], methods.index(row["method"]))
    cases = lambda row: (row["scene"], row["width"], row["light_scale"], row["sweep"], row["caster_faces"])
    out = {}
    for case in dict.fromkeys(map(cases, rows)):
        for budget in BUDGETS:
            within = [row for row in rows if cases(row) == case and row["error"] <= budget]
            best = min(within, key=lambda row: row["frame_ms"], default=None)
            tied = [row for row in within if is_tied(row, best)]
            out[case, budget] = min(tied, key=rank)["method"] if tied else None
    return out


def main():
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    verdicts = {path: verdicts_of(rows_of(path)) for path in sys.argv[1:]}
    failed = False
    for one, other in itertools.combinations(verdicts, 2):
        a, b = verdicts[one], verdicts[other]
        shared = [key for key in a if key in b]
        differ = [key for key in shared if a[key] != b[key]]
        print(f"{len(shared) - len(differ)} of {len(shared)} verdicts the same: {one}, {other}")
        for key in differ:
            print(f"  {key[0][0]} within {key[1]}: {a[key]}, {b[key]}")
        failed = failed or bool(differ) or not shared
    sys.exit(1 if failed else 0)


if __name__ == "__main__":
    main()
