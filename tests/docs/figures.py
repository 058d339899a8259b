"""The figures of data/benchmarks/, by part and machine."""
import json
import re

from documents import ROOT


class Part:
    """The figures of one part of one machine's benchmarks."""

    def __init__(self, machine, part):
        self.machine, self.commit, self.date, self.figures = machine, part["commit"], part["date"], part["figures"]

    def median(self, name):
        figure = self.figures.get(name)
        return None if figure is None else figure["median"]

    def names_before(self, suffix):
        """What comes before the suffix in the names of figures, in the order of the numbers in it."""
        found = [name[: -len(suffix)] for name in self.figures if name.endswith(suffix)]
        return sorted(found, key=lambda name: [(0, float(word), "") if re.fullmatch(r"[\d.]+", word) else (1, 0.0, word)
                                               for word in re.split(r"[/ ]", name)])

    def origin(self):
        m = self.machine
        return f"{m['processor']}, {m['cores']} cores, {m['instruction_set']}; commit {self.commit}, {self.date}."


def parts_named(name):
    found = []
    for path in sorted((ROOT / "data/benchmarks").glob("*.json")):
        record = json.loads(path.read_text())
        if name in record["parts"]:
            found.append(Part(record["machine"], record["parts"][name]))
    return found


def each_machine(name, table):
    """One table a machine, each with its origin; nothing where no machine has the part."""
    return "\n".join(f"{part.origin()}\n\n{table(part)}" for part in parts_named(name))


def first_machine(name, table):
    parts = parts_named(name)
    return f"{parts[0].origin()}\n\n{table(parts[0])}" if parts else ""


def scenes_of(part, suffix):
    """Scenes by their casters, in the order of the benchmark's sizes."""
    sizes = {"small": 0, "medium": 1, "large": 2}
    names = {name[: -len(suffix)] for name in part.figures if name.endswith(suffix)}
    return sorted(names, key=lambda name: (name.rpartition("-")[0] or name, sizes.get(name.rpartition("-")[2], 3), name))
