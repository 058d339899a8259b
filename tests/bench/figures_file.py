"""Figures of benchmarks that are Python programs, in the files of data/benchmarks/ (tests/bench/record.h)."""
import datetime
import json


def spread(values):
    """As tests/bench/record.cpp has it."""
    values = sorted(values)
    n = len(values)
    low, median, high = (float(f"{v:.5g}") for v in (values[n // 4], values[n // 2], values[n - 1 - n // 4]))
    return {"unit": "", "median": median, "low": low, "high": high, "runs": n}


def write(file, commit, part_name, figures):
    """Replaces one part of a file of figures, all else stays as it is written there: one figure a line."""
    record = json.loads(file.read_text())
    record["parts"][part_name] = {"commit": commit, "date": datetime.date.today().isoformat(), "figures": figures}
    lines = []
    for name, part in sorted(record["parts"].items()):
        each = ",\n ".join(f"{json.dumps(key)}: {dense(value)}" for key, value in sorted(part["figures"].items()))
        lines.append(f'{json.dumps(name)}: {{"commit": {json.dumps(part["commit"])}, "date": {json.dumps(part["date"])}, '
                     f'"figures": {{\n {each}}}}}')
    file.write_text(f'{{\n"machine": {dense(record["machine"])},\n"renderer": {json.dumps(record["renderer"])},\n'
                    '"parts": {\n' + ",\n".join(lines) + "\n}\n}\n")


def dense(value):
    return json.dumps(value, sort_keys=True, separators=(",", ":"), ensure_ascii=False)
