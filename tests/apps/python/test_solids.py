"""Solids, classes, silhouettes and pictures: sizes, closed forms, and agreement with visibility."""
import pathlib

import numpy as np
import penumbra
import pytest
import shapes

DATA = pathlib.Path(__file__).resolve().parents[3] / "data"
BOX = penumbra.Scene(*shapes.box())
ABOVE = penumbra.DiskLight((0, 4, 0), (0, -1, 0), 0.25)
BOUND = [[-1.5, -1, -1.5], [1.5, 2, 1.5]]


def volume(V, F):
    a, b, c = (V[F[:, k]] for k in range(3))
    return np.einsum("ij,ij->", a, np.cross(b, c)) / 6.0


def is_closed(F):
    edges = np.concatenate([F[:, [0, 1]], F[:, [1, 2]], F[:, [2, 0]]])
    forward = {tuple(e) for e in edges.tolist()}
    return len(forward) == len(edges) and all((b, a) in forward for a, b in forward)


@pytest.fixture(scope="module")
def umbra():
    return penumbra.umbra(BOX, ABOVE, bound=BOUND, tolerance=0.1, report=True)


def test_an_umbra_is_closed_and_as_large_as_it_says(umbra):
    V, F, report = umbra
    assert V.dtype == np.float64 and V.shape[1] == 3
    assert F.dtype == np.uint32 and F.shape[1] == 3
    assert is_closed(F)
    assert volume(V, F) == pytest.approx(report["volume"], rel=1e-9)
    assert report["guarantee"] in ("certified", "within")
    assert report["is_proved"].shape == report["is_far_cap"].shape == (len(F),)
    assert report["is_far_cap"].any() and not report["is_far_cap"].all()
    assert report["proved"] == np.count_nonzero(report["is_proved"] & ~report["is_far_cap"])
    # Below the top face, between the truth's frustum and nothing: it is contained, and misses no more than a layer of the tolerance.
    # Each side of the square section at height y is 1 + 2 (0.5 - 0.25) / 2.5 * (1.5 - y), from the body's top edge on.
    y = np.linspace(-1, 1.5, 2001)
    truth = np.trapz((1 + 0.2 * (1.5 - y)) ** 2, y)
    assert 0.8 * truth < report["volume"] < 1.001 * truth


def test_points_inside_an_umbra_see_nothing(umbra):
    V, F, _ = umbra
    # The umbra of a convex body under a disk is convex: means of its vertices are inside. Those in the box are hidden, too.
    weights = np.random.default_rng(1).dirichlet(np.ones(len(V)), 1000)
    inside = weights @ V
    assert BOX.visibility(inside, ABOVE).max() == 0.0


def test_a_penumbra_holds_a_level_holds_an_umbra(umbra):
    options = dict(bound=BOUND, tolerance=0.1, report=True)
    most = penumbra.penumbra(BOX, ABOVE, **options)[2]["volume"]
    half = penumbra.level(BOX, ABOVE, 0.5, **options)[2]["volume"]
    assert umbra[2]["volume"] < half < most
    V, F = penumbra.level(BOX, ABOVE, 0.5, bound=BOUND, tolerance=0.1)
    assert is_closed(F) and volume(V, F) == pytest.approx(half, rel=1e-9)


def test_classes_of_a_box_below_a_small_light():
    V, F = shapes.box()
    normals = np.cross(V[F[:, 1]] - V[F[:, 0]], V[F[:, 2]] - V[F[:, 0]])
    up = normals[:, 1] / np.linalg.norm(normals, axis=1)
    expected = np.where(up > 0.5, 2, 0)
    classes = penumbra.classify(BOX, ABOVE)
    assert classes.dtype == np.int8
    np.testing.assert_array_equal(classes, expected)
    # A disk that reaches over the box's sides: planes of the sides cut it.
    wide = penumbra.classify(BOX, penumbra.DiskLight((0, 4, 0), (0, -1, 0), 2.0))
    np.testing.assert_array_equal(wide, np.select([up > 0.5, up < -0.5], [2, 0], 1))


def test_classes_follow_the_rows_of_f():
    V, F = shapes.box()
    scene = penumbra.Scene(V, np.insert(F, 5, [3, 3, 3], axis=0))
    classes = penumbra.classify(scene, ABOVE)
    assert classes.shape == (13,) and classes[5] == -1
    np.testing.assert_array_equal(np.delete(classes, 5), penumbra.classify(BOX, ABOVE))


def test_silhouettes_of_a_box_are_its_top_edge():
    found = penumbra.silhouettes(BOX, ABOVE)
    V = found["vertices"]
    assert V.shape == (8, 3) and V.dtype == np.float64
    for name in ("umbra", "penumbra", "band"):
        edges = found[name]
        assert edges.dtype == np.uint32 and edges.shape == (4, 2)
        ends = V[edges]
        np.testing.assert_array_equal(ends[..., 1], 1.5)
        np.testing.assert_allclose(np.linalg.norm(ends[:, 0] - ends[:, 1], axis=1), 1.0)


def test_a_picture_is_its_channels():
    scene = penumbra.Scene(*shapes.plate(half=10.0, y=0.0))
    scene.add(*shapes.box())
    scene.lights = [ABOVE]
    scene.camera = penumbra.Camera((2, 3, 4), (0, 0.5, 0))
    picture, stats = penumbra.render(scene, size=(80, 60), stats=True)
    assert {"R", "G", "B", "A", "visibility", "region", "object", "P.X", "P.Y", "P.Z", "N.X", "N.Y", "N.Z"} <= set(picture)
    for channel in picture.values():
        assert channel.shape == (60, 80) and channel.dtype == np.float32
    assert stats["method"] == "silhouette" and stats["frame_ms"] > 0
    floor = picture["object"] == 0
    assert floor.any() and (picture["object"] == 1).any()
    # The same points by the call, from the picture's own float channels.
    points = np.stack([picture["P.X"], picture["P.Y"], picture["P.Z"]], axis=-1)[floor].astype(float)
    np.testing.assert_allclose(scene.visibility(points, ABOVE), picture["visibility"][floor], atol=1e-3)


def test_a_picture_of_a_file():
    path = DATA / "scenes/cube-small.json"
    picture = penumbra.render(path, size=(32, 24))
    scene = penumbra.Scene.from_file(path)
    same = penumbra.render(scene, size=(32, 24))
    np.testing.assert_array_equal(picture["R"], same["R"])
    assert scene.camera is not None and len(scene.lights) == 1


def test_dbuffer_draws_again_and_again():
    path = DATA / "scenes/cube-small.json"
    first, second = (penumbra.render(path, "dbuffer", size=(64, 48))["visibility"] for _ in range(2))
    np.testing.assert_array_equal(first, second)
    assert 0.0 <= first.min() < first.max() <= 1.0


def test_a_bare_mesh_is_a_scene():
    scene = penumbra.Scene.from_file(DATA / "meshes/bunny.ply")
    assert len(scene) == 2
    V, F = scene.mesh(1)
    assert F.max() == len(V) - 1
    low, high = scene.bounds
    assert (low < V.min(axis=0) + 1e-9).all() and (high > V.max(axis=0) - 1e-9).all()
