"""Reads the field of a scene as another program does, and compares it with its NPY file, byte by byte.

usage: read_field.py numpy|vtk|openvdb PENUMBRA SCENE

Exit code 77 where the reader's module is not installed.
"""
import ast
import importlib
import pathlib
import struct
import subprocess
import sys
import tempfile

MODULES = {"numpy": "numpy", "vtk": "vtkmodules.vtkIOXML", "openvdb": "pyopenvdb"}
EXTENSIONS = {"numpy": "npy", "vtk": "vti", "openvdb": "vdb"}
GRID = 40


def module_of(reader):
    """None where it is not installed; a line says so."""
    try:
        return importlib.import_module(MODULES[reader])
    except ImportError:
        print(f"{MODULES[reader]} is not installed: the field was not read by {reader}")
        return None


def expected(path):
    """Shape and values of an NPY file, read without NumPy."""
    data = path.read_bytes()
    assert data[:8] == b"\x93NUMPY\x01\x00"
    length = struct.unpack("<H", data[8:10])[0]
    header = ast.literal_eval(data[10:10 + length].decode())
    assert header["descr"] == "<f4" and not header["fortran_order"]
    nz, ny, nx = header["shape"]
    return (nx, ny, nz), struct.unpack(f"<{nx * ny * nz}f", data[10 + length:])


def by_numpy(module, path, counts, values):
    array = module.load(path)
    assert array.shape == counts[::-1], array.shape
    assert array.dtype == module.float32
    assert array.ravel().tolist() == list(values)


def vtk_image(module, path):
    """The image, and its array of values."""
    reader = module.vtkXMLImageDataReader()
    reader.SetFileName(str(path))
    reader.Update()
    image = reader.GetOutput()
    return image, image.GetPointData().GetArray("seen")


def by_vtk(module, path, counts, values):
    image, seen = vtk_image(module, path)
    assert image.GetDimensions() == counts, image.GetDimensions()
    assert min(image.GetSpacing()) > 0.0
    assert [seen.GetValue(i) for i in range(seen.GetNumberOfTuples())] == list(values)


def by_openvdb(module, path, counts, values):
    grid = module.read(str(path), "seen")
    assert grid.background == 1.0
    nx, ny, nz = counts
    accessor = grid.getConstAccessor()
    found = [accessor.getValue((i, j, k)) for k in range(nz) for j in range(ny) for i in range(nx)]
    assert found == list(values)
    assert grid.leafCount() * 512 < len(values), "not sparse"
    first, second = grid.transform.indexToWorld((0, 0, 0)), grid.transform.indexToWorld((1, 1, 1))
    assert all(b > a for a, b in zip(first, second))


def main():
    reader, penumbra, scene = sys.argv[1:]
    module = module_of(reader)
    if module is None:
        return 77
    with tempfile.TemporaryDirectory() as folder:
        files = {kind: pathlib.Path(folder) / f"seen.{kind}" for kind in {"npy", EXTENSIONS[reader]}}
        for kind, path in files.items():
            done = subprocess.run([penumbra, "field", scene, "--grid", str(GRID), "--output", str(path)],
                                  capture_output=True, text=True)
            assert done.returncode == 0, done.stderr
        counts, values = expected(files["npy"])
        assert max(counts) == GRID and 0.0 in values and 1.0 in values
        globals()[f"by_{reader}"](module, files[EXTENSIONS[reader]], counts, values)
    print(f"{reader} reads {len(values)} values as they were written")
    return 0


if __name__ == "__main__":
    sys.exit(main())
