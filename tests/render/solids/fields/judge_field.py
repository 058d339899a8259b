"""Judges voxels of a field around the casters of a scene, as VTK or OpenVDB reads them, by rays in double.

usage: judge_field.py vtk|openvdb PENUMBRA JUDGE SCENE GRID VOXELS

The field is a cube of GRID³ voxels around (0, 1, 0), four units long: a bunny and its shadow. The reader's own transform says where a
voxel lies. A third of the VOXELS see nothing, a third a part and a third all of the light. Exit code 77 where the reader's module
is not installed.
"""
import json
import pathlib
import random
import subprocess
import sys
import tempfile

from read_field import EXTENSIONS, module_of, vtk_image

LOW, HIGH = (-2.0, -1.0, -2.0), (2.0, 3.0, 2.0)
SEED = 22


def scene_in_cube(scene, folder):
    """The scene's casters, and a cube that casts nothing and so is the bound of the field."""
    corners = [[(HIGH if i >> k & 1 else LOW)[k] for k in range(3)] for i in range(8)]
    faces = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)]
    (folder / "cube.off").write_text("OFF\n8 6 0\n" + "".join(" ".join(map(str, p)) + "\n" for p in corners)
                                     + "".join("4 " + " ".join(map(str, f)) + "\n" for f in faces))
    data = json.loads(scene.read_text())
    data["objects"] = [dict(o, mesh=str((scene.parent / o["mesh"]).resolve())) for o in data["objects"] if o.get("casts", True)]
    data["objects"].append({"mesh": "cube.off", "casts": False})
    path = folder / "scene.json"
    path.write_text(json.dumps(data))
    return path


def by_vtk(module, path):
    image, seen = vtk_image(module, path)

    def voxel(*index):
        at = image.ComputePointId(index)
        return image.GetPoint(at), seen.GetValue(at)

    return voxel


def by_openvdb(module, path):
    grid = module.read(str(path), "seen")
    accessor = grid.getConstAccessor()
    return lambda *index: (grid.transform.indexToWorld(index), accessor.getValue(index))


def chosen(voxel, grid, count):
    random.seed(SEED)
    wanted = {"none": (count + 2) // 3, "part": (count + 1) // 3, "all": count // 3}
    lines = []
    for _ in range(1000 * count):
        point, seen = voxel(*(random.randrange(grid) for _ in range(3)))
        kind = "none" if seen == 0.0 else "all" if seen == 1.0 else "part"
        if wanted[kind] == 0:
            continue
        wanted[kind] -= 1
        lines.append(" ".join(map(repr, (*point, seen))))
        if len(lines) == count:
            return lines
    raise AssertionError(f"too few voxels: {wanted}")


def main():
    reader, penumbra, judge, scene, grid, voxels = sys.argv[1:]
    module = module_of(reader)
    if module is None:
        return 77
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        path = folder / f"seen.{EXTENSIONS[reader]}"
        cube = scene_in_cube(pathlib.Path(scene), folder)
        subprocess.run([penumbra, "field", str(cube), "--grid", grid, "--output", str(path)], check=True)
        voxel = globals()[f"by_{reader}"](module, path)
        # The field ends a little beyond the cube.
        first, last = voxel(0, 0, 0)[0], voxel(*(int(grid) - 1,) * 3)[0]
        for low, high, a, b in zip(LOW, HIGH, first, last):
            assert abs(low + high - a - b) < 1e-9 and 0.0 <= low - a < 0.05 * (high - low), (first, last)
        lines = chosen(voxel, int(grid), int(voxels))
        print(f"{reader}, {grid}³: ", end="", flush=True)
        return subprocess.run([judge, str(cube), "1024"], input="\n".join(lines) + "\n", text=True).returncode


if __name__ == "__main__":
    sys.exit(main())
