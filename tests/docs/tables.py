"""Makes the tables of docs/ from data/benchmarks/, between <!-- table: NAME --> and <!-- end -->.

usage: tables.py [--check]

With --check nothing is written; the exit code is 1 where a table differs. Times get one table a machine; errors and counts,
which hardly depend on it, are those of the first machine that has them.
"""
import re
import sys

from documents import ROOT, documents
from figures import each_machine, first_machine, parts_named, scenes_of
from moving_light_tables import kept_frames, pops, viewer_pace
from table_text import error, markdown, number

MARK = re.compile(r"<!-- table: ([\w-]+) -->\n(.*?)<!-- end -->", re.DOTALL)


# The tables. Each takes one part and returns markdown.

def errors_by(columns, suffix="/silhouette/frame"):
    def both(part, scene, method):
        floor, casters = (part.median(f"{scene}/{method}/RMSE {where}") for where in ("floor", "casters"))
        return error(floor) if not casters else f"{error(floor)} ; {error(casters)}"

    def table(part):
        rows = [[scene] + [both(part, scene, method) for method in columns.values()]
                for scene in scenes_of(part, suffix)]
        return markdown(["scene", *columns], rows)
    return table


ALL_ERRORS = errors_by({"`dbuffer`": "dbuffer", "`occlusion-textures`": "occlusion-textures", "`hard`": "hard",
                        "16 rays": "reference, 16 rays", "64 rays": "reference, 64 rays", "256 rays": "reference, 256 rays"})
DBUFFER_ERRORS = errors_by({name: name for name in ("default", "two entries", "no rays asked", "furthest", "the paper's")},
                           "/pixels in penumbra")


def checked(part):
    scenes = ["triangle-small", "speck-small", "cube-small", "cube-large", "boxes-large", "bunny-small", "armadillo-medium",
              "foliage-medium", "building", "tree"]
    sizes = ["160x120", "640x480", "1280x960"]
    rows = [[scene] + [" ; ".join(error(part.median(f"{scene}/{size}/{check}/RMSE")) for check in ("rays", "none"))
                       for size in sizes] for scene in scenes]
    return markdown(["scene", *(size.replace("x", "×") for size in sizes)], rows)


OCCLUSION_ERRORS = errors_by({"default": "occlusion-textures", "8 slices": "occlusion-textures, 8 slices",
                              "all faces": "occlusion-textures, all faces"})


def frames(part):
    methods = {"`silhouette`": "silhouette", "`dbuffer`": "dbuffer", "the paper's D-buffer": "dbuffer, the paper's",
               "`occlusion-textures`": "occlusion-textures", "`hard`": "hard", "64 rays": "reference, 64 rays",
               "256 rays": "reference, 256 rays"}
    rows = [[scene] + [number(part.median(f"{scene}/{method}/frame")) for method in methods.values()]
            for scene in scenes_of(part, "/silhouette/frame")]
    return markdown(["scene", *methods], rows)


def silhouette_errors(part):
    rows = [[scene, error(part.median(f"{scene}/RMSE")),
             f"{error(part.median(f'{scene}/RMSE at least'))} to {error(part.median(f'{scene}/RMSE at most'))}",
             f"{part.median(f'{scene}/certified of lit'):.4f}", f"{part.median(f'{scene}/certified of umbra'):.3f}"]
            for scene in scenes_of(part, "/RMSE")]
    return markdown(["scene", "RMSE", "95% interval", "certified of lit", "certified of umbra"], rows)


def judged(part):
    methods = ("silhouette", "reference", "dbuffer")
    rows = [[scene, number(part.median(f"{scene}/pixels in penumbra"))]
            + [error(part.median(f"{scene}/{method}")) for method in methods]
            for scene in scenes_of(part, "/pixels in penumbra")]
    return markdown(["scene", "pixels judged", "`silhouette`", "`reference`, 4,096 rays", "`dbuffer`"], rows)


def silhouette_times(part):
    rows = [[scene, number(part.median(f"{scene}/silhouette")),
             number(part.median(f"{scene}/reference : silhouette")), number(part.median(f"{scene}/rays : silhouette")),
             number(part.median(f"{scene}/edges across the disk")), number(part.median(f"{scene}/hierarchy of edges")),
             number(part.median(f"{scene}/hierarchy of faces"))]
            for scene in scenes_of(part, "/reference : silhouette")]
    return markdown(["scene", "`silhouette`, ms", "`reference` takes", "`rays` takes", "edges a receiver",
                     "hierarchy of edges, ms", "hierarchy of faces, ms"], rows)


def growth(part):
    rows = [[name.partition("/")[0], number(float(name.partition("/")[2].removesuffix(" faces"))),
             number(part.median(f"{name}/visibility")), number(part.median(f"{name}/times the first"))]
            for name in part.names_before("/times the first")]
    return markdown(["mesh", "faces", "ms", "times the first"], rows)


def radii(part):
    rows = [[name.partition("radius ")[2]] + [number(part.median(f"{name}/{method}"))
                                              for method in ("silhouette", "rays", "reference")]
            for name in part.names_before("/silhouette")]
    return markdown(["radius", "`silhouette`", "`rays`, 256", "`reference`, 256"], rows)


def rays_of(part, scene):
    figure = part.figures[f"{scene}/rays of equal error"]
    return ("more than " if "at least" in figure["unit"] else "") + number(figure["median"])


def d_buffer(part):
    rows = [[scene, number(part.median(f"{scene}/dbuffer")), error(part.median(f"{scene}/RMSE")),
             rays_of(part, scene), number(part.median(f"{scene}/reference")),
             number(part.median(f"{scene}/dbuffer : reference"))]
            for scene in scenes_of(part, "/dbuffer : reference")]
    return markdown(["scene", "`dbuffer`, ms", "RMSE", "rays a pixel of that error", "`reference`, ms",
                     "`dbuffer` : `reference`"], rows)


def numbered(part, pattern):
    """Names of figures that match, by the number in them."""
    found = [(float(match[1]), name) for name in part.figures if (match := re.fullmatch(pattern, name))]
    return sorted(found)


def in_a_row(part, pattern, shown):
    return ", ".join(f"{value:g}: {shown(part.median(name))}" for value, name in numbered(part, pattern))


def d_buffer_growth(part):
    rows = [["sphere, by faces", in_a_row(part, r"sphere/(\d+) faces", number)],
            ["armadillo-medium, by texels a side", in_a_row(part, r"armadillo-medium/size (\d+)", number)],
            ["knot1-medium, by the light's radius", in_a_row(part, r"knot1-medium/radius ([\d.]+)", number)]]
    return markdown(["what grows", "ms"], rows)


def prefilters(part):
    rows = [[f"{size}²"] + [number(part.median(f"prefilter/{size}/{which}"))
                            for which in ("mipmap", "nbuffer", "sat", "nbuffer : sat")] for size in (256, 512)]
    return markdown(["texels", "mipmap, ms", "N-buffer, ms", "summed-area table, ms", "N-buffer : table"], rows)


def occlusion_growth(part):
    rows = [[f"{scene}, by radius", in_a_row(part, scene + r"/radius ([\d.]+)/times the first", number)]
            for scene in ("cube-medium", "foliage-medium")]
    rows.append(["foliage-medium, by slices, ms", in_a_row(part, r"foliage-medium/slices (\d+)/frame", number)])
    return markdown(["what grows", ""], rows)


def price(part):
    ways = ("float", "double", "filtered", "exact")
    rows = []
    for name in scenes_of(part, "/filtered : double"):
        wrong = [part.median(f"{name}/{way}/wrong") for way in ways]
        times = [part.median(f"{name}/{way}") for way in ways]
        rows.append([name, number(part.median(f"{name}/faces"))]
                    + [f"{number(t)}, {number(w)} wrong" for t, w in zip(times[:3], wrong)]
                    + [number(times[3]), number(part.median(f"{name}/filtered : double"))])
    return markdown(["input", "faces", "float", "double", "filtered", "always exact", "filtered : double"], rows)


def volumes(part):
    rows = [[scene, number(part.median(f"{scene}/faces"))]
            + [number(part.median(f"{scene}/a cell a {unit}/{what}")) for unit in ("face", "patch")
               for what in ("cells", "triangles")]
            + [number(part.median(f"{scene}/a cell a patch/time")), number(part.median(f"{scene}/patch : face"))]
            for scene in sorted(scenes_of(part, "/patch : face"), key=lambda name: (part.median(f"{name}/faces"), name))]
    return markdown(["scene", "faces", "cells, one a face", "triangles", "cells, one a patch", "triangles", "ms",
                     "time of patches : faces"], rows)


def umbras(part):
    names = sorted((name for name in part.figures if name.endswith("/umbra")), key=lambda name: (part.median(name), name))
    return markdown(["caster", "ms"], [[name.removesuffix("/umbra"), number(part.median(name))] for name in names])


def percent(value):
    return "" if value is None else f"{100 * value:.1f}%"


def solids(part):
    def kind(scene, name):
        time = part.median(f"{scene}/{name}/time")
        return [number(part.median(f"{scene}/{name}/triangles")), "" if time is None else number(time / 1000.0),
                percent(part.median(f"{scene}/{name}/proved"))]

    return markdown(["scene", "umbra, triangles", "s", "proved", "penumbra, triangles", "s", "proved"],
                    [[scene] + kind(scene, "umbra") + kind(scene, "penumbra") for scene in scenes_of(part, "/umbra/time")])


def fields(part):
    return markdown(["scene", "umbra", "penumbra", "s"],
                    [[scene, percent(part.median(f"{scene}/field/umbra")), percent(part.median(f"{scene}/field/penumbra")),
                      number(part.median(f"{scene}/field/time") / 1000.0)] for scene in scenes_of(part, "/field/time")])


def judged_solids(part):
    def both(scene, figure):
        return sum(part.median(f"{scene}/{kind}/{figure}") or 0 for kind in ("umbra", "penumbra"))

    def sound(scene):
        return "yes" if both(scene, "sound") == 2 else "NO"

    return markdown(["scene", "sound", "points", "wrong", "proofs contradicted", "umbra missed", "penumbra in surplus"],
                    [[scene, sound(scene), number(both(scene, "points")), number(both(scene, "wrong points")),
                      number(both(scene, "contradicted proofs")), percent(part.median(f"{scene}/umbra/missed")),
                      percent(part.median(f"{scene}/penumbra/surplus"))] for scene in scenes_of(part, "/umbra/missed")])


def sun_year(part):
    def figure(name):
        return part.median(f"city-block/{name}")

    rows = [["exact areas", number(figure("areas") / 1000.0), number(figure("areas") / figure("suns")), "", ""],
            ["64 rays a receiver", number(figure("rays64") / 1000.0), number(figure("rays64") / figure("suns")),
             number(figure("rays64") / figure("areas")), error(figure("rays64-rmse"))]]
    return markdown([f"{number(figure('receivers'))} receivers, {number(figure('suns'))} suns by day", "s", "ms a sun", "times as long",
                     "RMSE where the sun is seen in part"], rows)


def python_calls(part):
    rows = [[scene, number(part.median(f"{scene}/points")), number(part.median(f"{scene}/wall clock/Python")),
             number(part.median(f"{scene}/wall clock/C++")), number(part.median(f"{scene}/wall clock/Python : C++")),
             number(part.median(f"{scene}/rays of equal RMSE")), number(part.median(f"{scene}/those rays : silhouette"))]
            for scene in scenes_of(part, "/rays of equal RMSE")]
    return markdown(["scene", "points", "Python, ms", "C++, ms", "ratio", "rays a point of equal RMSE", "they take, times"], rows)


def terrain(part):
    def cell(side, name):
        time, memory = (part.median(f"{side}/{name}{what}") for what in ("", "-memory"))
        return "" if time is None else f"{number(time / 1000.0)} ; {number(memory / 1024.0)}"

    names = {"tiles": "tiles", "`reference`, the first call": "reference-first", "the next": "reference-next", "`silhouette`, the first call": "silhouette-first",
             "the next ": "silhouette-next"}
    rows = [[f"{side}²"] + [cell(side, name) for name in names.values()] for side in part.names_before("/tiles")]
    return markdown(["posts", *(name.strip() for name in names)], rows)


# name, when, figure's name, lights, needs
METHODS = [
    ("`silhouette`", "exact areas, no noise", "silhouette", "disk, distant", "CPU"),
    ("`dbuffer`", "shadow boundaries by OpenGL; the 2004 paper and our corrections", "dbuffer", "disk, distant", "OpenGL 4.5"),
    ("`occlusion-textures`", "many small faces; time does not depend on the light's size", "occlusion-textures",
     "disk, rectangle, distant", "OpenGL 4.5"),
    ("`reference`, 256 rays", "to judge the others", "reference, 256 rays", "disk, rectangle, distant", "CPU"),
    ("`rays`, 256 rays", "the same, with rays only where nothing is certified", "rays, 256 rays", "disk, distant", "CPU"),
    ("`hard`", "a point light's shadow", "hard", "disk, rectangle, distant", "CPU"),
]


def methods(part, scene="armadillo-medium"):
    def error_of(figure):
        if figure != "silhouette":
            return error(part.median(f"{scene}/{figure}/RMSE floor"))
        against_rays = parts_named("silhouette")
        return error(against_rays[0].median(f"{scene}/RMSE")) if against_rays else ""

    rows = [[name, when, error_of(figure), f"{number(part.median(f'{scene}/{figure}/frame'))} ms", lights, needs]
            for name, when, figure, lights, needs in METHODS]
    return markdown(["method", "when", "error", "time", "lights", "needs"], rows)


TABLES = {
    "methods": lambda: first_machine("accuracy", methods),
    "accuracy": lambda: first_machine("accuracy", ALL_ERRORS),
    "dbuffer-error": lambda: first_machine("dbuffer-judge", DBUFFER_ERRORS),
    "dbuffer-check": lambda: first_machine("dbuffer-check", checked),
    "occlusion-error": lambda: first_machine("accuracy", OCCLUSION_ERRORS),
    "silhouette-error": lambda: first_machine("silhouette", silhouette_errors),
    "judge": lambda: first_machine("judge", judged),
    "frames": lambda: each_machine("accuracy", frames),
    "kept-frames": lambda: each_machine("frames", kept_frames),
    "pops": lambda: first_machine("pops", pops),
    "viewer-pace": lambda: each_machine("viewer", viewer_pace),
    "silhouette-time": lambda: each_machine("silhouette", silhouette_times),
    "growth": lambda: each_machine("growth", growth),
    "radii": lambda: each_machine("growth", radii),
    "dbuffer": lambda: each_machine("dbuffer", d_buffer),
    "dbuffer-growth": lambda: each_machine("dbuffer", d_buffer_growth),
    "prefilters": lambda: each_machine("occlusion", prefilters),
    "occlusion-growth": lambda: each_machine("occlusion", occlusion_growth),
    "price": lambda: each_machine("price", price),
    "volumes": lambda: first_machine("volumes", volumes),
    "umbra": lambda: each_machine("volumes", umbras),
    "solids": lambda: each_machine("solids", solids),
    "fields": lambda: each_machine("fields", fields),
    "sun-year": lambda: each_machine("sun", sun_year),
    "python-calls": lambda: each_machine("python", python_calls),
    "terrain": lambda: each_machine("terrain", terrain),
    "solids-judge": lambda: first_machine("solids-judge", judged_solids),
}


def with_tables(text, used):
    def replaced(match):
        name = match[1]
        used.add(name)
        if name not in TABLES:
            sys.exit(f"no table {name}; there are {', '.join(TABLES)}")
        return f"<!-- table: {name} -->\n{TABLES[name]()}<!-- end -->"
    return MARK.sub(replaced, text)


def main():
    check, used, differing = "--check" in sys.argv[1:], set(), []
    for document in documents():
        path = ROOT / document
        text = path.read_text()
        made = with_tables(text, used)
        if made == text:
            continue
        differing.append(str(document))
        if not check:
            path.write_text(made)
    if unused := set(TABLES) - used:
        sys.exit(f"no document has the tables {', '.join(sorted(unused))}")
    print(("differs: " if check else "written: ") + (", ".join(differing) or "nothing"))
    return 1 if check and differing else 0


sys.exit(main())
