"""What cannot be used is refused: each message says what, where and what to do."""
import numpy as np
import penumbra
import pytest
import shapes

LIGHT = penumbra.DiskLight((0, 2, 0), (0, -1, 0), 0.5)
SCENE = penumbra.Scene(*shapes.plate())
V, F = shapes.plate()
NAN = float("nan")


def with_value(array, place, value):
    out = np.array(array)
    out[place] = value
    return out


@pytest.mark.parametrize("points, kind, message", [
    (np.zeros((4, 2)), ValueError, r"points has shape \(4, 2\); the last axis must have length 3"),
    (np.float64(3), ValueError, r"points has shape \(\)"),
    ([], ValueError, r"points has shape \(0,\)"),
    (with_value(np.zeros((2, 5, 3)), (1, 2, 0), NAN), ValueError, r"points\[1, 2\] is \(nan, 0.0+, 0.0+\); .*finite"),
    (with_value(np.zeros((7, 3)), (6, 1), np.inf), ValueError, r"points\[6\] is"),
    ([NAN, 0, 0], ValueError, r"points is \(nan"),
    (np.zeros((4, 3), complex), TypeError, "points has the type complex128; give real numbers"),
    (np.zeros((4, 3), bool), TypeError, "points has the type bool"),
    ([["a", "b", "c"]], TypeError, "points has the type <U1"),
    ([[1, 2, 3], [1, 2]], TypeError, "points"),
    (None, TypeError, "points"),
])
def test_points(points, kind, message):
    with pytest.raises(kind, match=message):
        SCENE.visibility(points, LIGHT)


@pytest.mark.parametrize("vertices, triangles, kind, message", [
    (V[:, :2], F, ValueError, r"V has shape \(4, 2\)"),
    (V[None], F, ValueError, r"V has shape \(1, 4, 3\); give \(n, 3\)"),
    (with_value(V, (2, 1), NAN), F, ValueError, r"V\[2\] is"),
    (V, F[:, :2], ValueError, r"F has shape \(2, 2\); give \(m, 3\)"),
    (V, F.astype(float), TypeError, "F has the type float64; give integers"),
    (V, with_value(F, (1, 2), 4), ValueError, r"F\[1\] names vertex 4, but there are 4 vertices, numbered from 0"),
    (V, with_value(F, (0, 0), -1), ValueError, r"F\[0\] names vertex -1"),
    (V, F.astype(np.uint64) + np.uint64(2**63), ValueError, r"F\[0\] names vertex"),
    (V, F[:0], ValueError, "F has no rows"),
    (V, [[0, 0, 1]], ValueError, "no row of F has three distinct corners"),
    (V, None, ValueError, "both V and F"),
])
def test_meshes(vertices, triangles, kind, message):
    with pytest.raises(kind, match=message):
        penumbra.Scene(vertices, triangles)


@pytest.mark.parametrize("matrix, message", [
    (np.eye(3), r"transform has shape \(3, 3\); give \(4, 4\) or \(3, 4\)"),
    (np.diag([1.0, 0, 1, 1]), "transform is singular"),
    (with_value(np.eye(4), (0, 3), NAN), "transform is not finite"),
    (with_value(np.eye(4), (3, 0), 5.0), "last row of transform"),
])
def test_transforms(matrix, message):
    scene = penumbra.Scene()
    with pytest.raises(ValueError, match=message):
        scene.add(V, F, matrix)
    assert len(scene) == 0


@pytest.mark.parametrize("make, message", [
    (lambda: penumbra.DiskLight((0, 0), (0, -1, 0), 1), r"center has shape \(2,\)"),
    (lambda: penumbra.DiskLight((0, 0, 0), (0, 0, 0), 1), "normal has length 0"),
    (lambda: penumbra.DiskLight((0, 0, 0), (0, -1, 0), -1), "radius"),
    (lambda: penumbra.DiskLight((0, NAN, 0), (0, -1, 0), 1), "center is not finite"),
    (lambda: penumbra.DiskLight((0, 2, 0), (0, -1, 0), 1, radiance=-1), "radiance"),
    (lambda: penumbra.DiskLight((0, 2, 0), (0, -1, 0), 1, radiance=(1, NAN, 1)), "radiance"),
    (lambda: penumbra.DiskLight((0, 2, 0), (0, -1, 0), 1, name="my lamp"), "my lamp"),
    (lambda: penumbra.DistantLight((0, -1, 0), 180), "angle"),
    (lambda: penumbra.RectangleLight((0, 2, 0), (0, -1, 0), (0, 1, 0), (1, 1)), "tangent"),
    (lambda: penumbra.Camera((0, 0, 0), (1, 0, 0), fov_y_degrees=0), "fov_y_degrees"),
    (lambda: penumbra.Scene().add(V, F, albedo=NAN), "albedo"),
    (lambda: penumbra.Scene().add(V, F, albedo=(0, 0.5, 80)), "albedo"),
    (lambda: penumbra.Camera((0, 0, 0), (0, 0, 0)), "eye equals target"),
    (lambda: penumbra.Camera((0, 0, 0), (0, 2, 0), up=(0, 1, 0)), "parallel to the line of sight"),
    (lambda: penumbra.Camera((0, 0, 0), (1, 0, 0), up=(0, 0, 0)), "up is 0"),
])
def test_lights_and_cameras(make, message):
    with pytest.raises(ValueError, match=message):
        make()


@pytest.mark.parametrize("given, kind, message", [
    (dict(normals=np.zeros((3, 3))), ValueError, r"normals have shape \(3, 3\), but points have \(2, 3\)"),
    (dict(normals=np.zeros((2, 3))), ValueError, "normal of receiver 0 has not length 1"),
    (dict(normals=[[0, 1, 0], [0, NAN, 0]]), ValueError, r"normals\[1\] is"),
    (dict(method="silhouete"), ValueError, "silhouette"),
    (dict(method="dbuffer-2"), ValueError, "dbuffer-2"),
    (dict(samples=4), ValueError, "method 'silhouette' has no option 'samples'; it has silhouette_rows"),
    (dict(method="reference", samples=0), ValueError, "samples"),
    (dict(method="reference", samples="many"), ValueError, "samples"),
    (dict(method="reference", max_error=0.1), ValueError, "max_error is for method 'auto'"),
    (dict(max_error=-1), ValueError, "max-error"),
    (dict(method="reference", region=True), ValueError, "certifies nothing"),
    (dict(objects=1), ValueError, "objects.* is 1, but the scene has 1 objects"),
    (dict(faces=[0, 2]), ValueError, r"faces\[1\] is 2, but object 0 has 2 triangles"),
    (dict(faces=[0, 1, 1]), ValueError, r"faces has shape \(3,\), but the points have \(2,\)"),
    (dict(faces=[0.5, 1]), TypeError, "faces has the type float64; give integers"),
])
def test_visibility(given, kind, message):
    with pytest.raises(kind, match=message):
        SCENE.visibility(np.zeros((2, 3)), LIGHT, **given)


@pytest.mark.parametrize("light, kind, message", [
    ("sun", ValueError, "sun"), (0, ValueError, "0"), (-1, ValueError, "-1"), (None, TypeError, "give a DiskLight"),
    ((0, 2, 0), TypeError, "give a DiskLight"),
    (penumbra.RectangleLight((0, 2, 0), (0, -1, 0), (1, 0, 0), (1, 1)), ValueError, "silhouette"),
])
def test_lights_that_are_not_taken(light, kind, message):
    with pytest.raises(kind, match=message):
        SCENE.visibility(np.zeros((2, 3)), light)


def test_files(tmp_path):
    with pytest.raises(FileNotFoundError, match="no such file"):
        penumbra.Scene.from_file(tmp_path / "none.ply")
    broken = tmp_path / "broken.json"
    broken.write_text('{"version": 1, "objects": [{"mesh": 3}]}')
    with pytest.raises(penumbra.SceneError, match="lights"):
        penumbra.Scene.from_file(str(broken))
    empty = tmp_path / "empty.ply"
    empty.write_text("ply\n")
    with pytest.raises(penumbra.MeshError, match="empty.ply"):
        penumbra.Scene.from_file(empty)
    assert issubclass(penumbra.MeshError, ValueError) and issubclass(penumbra.SceneError, ValueError)


def test_solids_and_pictures():
    with pytest.raises(ValueError, match="tolerance"):
        penumbra.umbra(SCENE, LIGHT, tolerance=0)
    with pytest.raises(ValueError, match=r"bound has shape \(1, 3\)"):
        penumbra.umbra(SCENE, LIGHT, bound=[[0, 0, 0]])
    with pytest.raises(ValueError, match="bound"):
        penumbra.umbra(SCENE, LIGHT, bound=[[0, 0, 0], [1, 2, 1]])  # does not hold the plate
    with pytest.raises(ValueError, match="first row is not below"):
        penumbra.umbra(SCENE, LIGHT, bound=[[0, 0, 0], [1, 0, 1]])
    with pytest.raises(IndexError, match="no object 1"):
        penumbra.classify(SCENE, LIGHT, 1)
    with pytest.raises(TypeError, match="give a Scene or the path"):
        penumbra.render(5)
    with pytest.raises(ValueError, match="no camera; set scene.camera"):
        penumbra.render(SCENE)
    with pytest.raises(ValueError, match="0x"):
        lit = penumbra.Scene(V, F)
        lit.camera, lit.lights = penumbra.Camera((0, 3, 3), (0, 0, 0)), [LIGHT]
        penumbra.render(lit, size=(0, 4))
