"""Scene.visibility against closed forms, and the arrays that it takes."""
import numpy as np
import penumbra
import pytest
import shapes

LIGHT = penumbra.DiskLight(center=(0, 2, 0), normal=(0, -1, 0), radius=0.5)
# Single precision in the engine's lanes.
CLOSE = 2e-6


@pytest.fixture(scope="module")
def half_plane():
    return penumbra.Scene(*shapes.plate(half=1000.0, edge_at_0=True))


def row(count=401):
    points = np.zeros((count, 3))
    points[:, 0] = np.linspace(-0.75, 0.75, count)
    return points


def test_behind_a_half_plane_it_is_the_segment_of_a_disk(half_plane):
    points = row()
    seen = half_plane.visibility(points, LIGHT)
    expected = shapes.half_plane_fraction(points[:, 0])
    assert seen.dtype == np.float32 and seen.shape == (401,)
    assert expected.min() == 0.0 and expected.max() == 1.0
    np.testing.assert_allclose(seen, expected, atol=CLOSE)


def test_a_plate_hides_the_disk_behind_its_middle():
    scene = penumbra.Scene(*shapes.plate(half=10.0))
    seen, region = scene.visibility([[0, 0, 0], [0, 1.5, 0], [100, 0, 0], [0, 3, 0]], LIGHT, region=True)
    # In umbra, between plate and light, far beside, behind the light's plane.
    assert seen.tolist() == [0.0, 1.0, 1.0, 0.0]
    assert region.dtype == np.int8
    assert region[0] in (2, -1) and region[1] in (0, -1) and region[3] == 2


def test_a_sphere_before_the_sun_is_a_disk_before_a_disk():
    # Seen along its axis the caster covers (tan a / tan s)^2 of the sun, a = asin(R / D).
    radius, distance, angle = 0.02, 4.0, 2.0
    scene = penumbra.Scene(*shapes.sphere((0, distance, 0), radius))
    seen = scene.visibility([0.0, 0.0, 0.0], penumbra.DistantLight((0, -1, 0), angle))
    covered = (np.tan(np.arcsin(radius / distance)) / np.tan(np.radians(angle / 2))) ** 2
    assert seen.shape == ()
    assert 0.05 < covered < 0.2
    assert float(seen) == pytest.approx(1.0 - covered, abs=0.003 * covered)


def test_the_horizon_of_a_normal_cuts_the_disk():
    scene = penumbra.Scene()
    up, across, down = [0, 1.0, 0], [1.0, 0, 0], [0, -1.0, 0]
    seen = scene.visibility(np.zeros((3, 3)), LIGHT, normals=[up, across, down])
    np.testing.assert_allclose(seen, [1.0, 0.5, 0.0], atol=CLOSE)


@pytest.mark.parametrize("method", ["silhouette", "auto", "reference", "rays", "hard", "none"])
def test_every_method_answers(half_plane, method):
    seen = half_plane.visibility(row(31), LIGHT, method=method)
    assert seen.shape == (31,)
    if method not in ("hard", "none"):
        np.testing.assert_allclose(seen, shapes.half_plane_fraction(row(31)[:, 0]), atol=0.05)


def test_any_leading_shape_is_kept(half_plane):
    flat = half_plane.visibility(row(24), LIGHT)
    cube = half_plane.visibility(row(24).reshape(2, 3, 4, 3), LIGHT)
    assert cube.shape == (2, 3, 4)
    np.testing.assert_array_equal(cube.ravel(), flat)


def test_memory_of_any_layout_gives_the_same(half_plane):
    points = row(64)
    expected = half_plane.visibility(points, LIGHT)
    wide = np.full((64, 7), 9.0)
    wide[:, 1:4] = points
    backward = points[::-1]
    big_endian = points.astype(">f8")
    misaligned = np.frombuffer(b"x" + points.tobytes(), np.uint8)[1:].view(np.float64).reshape(64, 3)
    assert not misaligned.flags.aligned
    same = [wide[:, 1:4], np.asfortranarray(points), big_endian, misaligned, points.tolist()]
    for each in same:
        np.testing.assert_array_equal(half_plane.visibility(each, LIGHT), expected)
    np.testing.assert_array_equal(half_plane.visibility(backward, LIGHT), expected[::-1])
    read_only = points.copy()
    read_only.flags.writeable = False
    np.testing.assert_array_equal(half_plane.visibility(read_only, LIGHT), expected)


def test_float32_is_taken_for_what_it_is(half_plane):
    narrow = row(64).astype(np.float32)
    np.testing.assert_array_equal(half_plane.visibility(narrow, LIGHT),
                                  half_plane.visibility(narrow.astype(np.float64), LIGHT))
    V, F = shapes.plate(half=1000.0, edge_at_0=True)
    same = penumbra.Scene(V.astype(np.float32), F.astype(np.uint8))
    np.testing.assert_array_equal(same.visibility(row(64), LIGHT), half_plane.visibility(row(64), LIGHT))


def test_no_points_give_no_values(half_plane):
    assert half_plane.visibility(np.zeros((0, 3)), LIGHT).shape == (0,)
    assert half_plane.visibility(np.zeros((4, 0, 3)), LIGHT).shape == (4, 0)


def test_the_result_is_the_callers_own(half_plane):
    seen = half_plane.visibility(row(8), LIGHT)
    again = half_plane.visibility(row(8), LIGHT)
    seen[:] = 7.0
    assert (again <= 1.0).all()
    assert seen.flags.writeable and seen.flags.c_contiguous


def test_an_empty_scene_hides_nothing():
    assert penumbra.Scene().visibility([[0, 0, 0]], LIGHT).tolist() == [1.0]


def test_objects_that_are_added_cast():
    scene = penumbra.Scene()
    assert scene.visibility([0.0, 0, 0], LIGHT) == 1.0
    assert scene.add(*shapes.plate(half=10.0)) == 0
    assert scene.visibility([0.0, 0, 0], LIGHT) == 0.0
    assert scene.add(*shapes.box((5, 0, 0)), casts=False) == 1
    assert len(scene) == 2


def test_a_transform_moves_turns_and_mirrors():
    V, F = shapes.plate(half=1000.0, edge_at_0=True)
    moved = penumbra.Scene()
    moved.add(V - [0.25, 0, 0], F, np.array([[1, 0, 0, 0.25], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]))
    np.testing.assert_allclose(moved.visibility(row(), LIGHT), shapes.half_plane_fraction(row()[:, 0]), atol=CLOSE)
    mirrored = penumbra.Scene()
    mirrored.add(*shapes.box(), np.diag([-1.0, 1, 1, 1]))
    light = penumbra.DistantLight((0, -1, 0))
    plain = penumbra.Scene(*shapes.box())
    # The faces that look up are the same two: winding was turned.
    np.testing.assert_array_equal(penumbra.classify(mirrored, light), penumbra.classify(plain, light))


def test_a_point_on_a_face_is_not_hidden_by_it():
    V, F = shapes.box()
    scene = penumbra.Scene(V, F)
    light = penumbra.DiskLight((3, 1, 0), (-1, 0, 0), 0.2)
    centers = V[F].mean(axis=1)
    across = np.cross(V[F][:, 1] - V[F][:, 0], V[F][:, 2] - V[F][:, 0])
    normals = across / np.linalg.norm(across, axis=1, keepdims=True)
    seen = scene.visibility(centers, light, normals, objects=0, faces=np.arange(12))
    faces_light = normals[:, 0] > 0.5
    assert faces_light.sum() == 2
    np.testing.assert_array_equal(seen, faces_light.astype(np.float32))
    alone = scene.visibility(centers, light, normals, faces=np.arange(12))
    np.testing.assert_array_equal(alone, seen)


def test_faces_are_rows_of_f_though_some_are_left_out():
    V, F = shapes.box()
    scene = penumbra.Scene(V, np.vstack([[[0, 0, 1]], F]))
    light = penumbra.DiskLight((3, 1, 0), (-1, 0, 0), 0.2)
    centers = V[F].mean(axis=1)
    np.testing.assert_array_equal(scene.visibility(centers, light, faces=np.arange(1, 13)),
                                  penumbra.Scene(V, F).visibility(centers, light, faces=np.arange(12)))
    with pytest.raises(ValueError, match=r"faces\[0\] is triangle 0 of object 0, which has no three distinct corners"):
        scene.visibility(centers[:1], light, faces=[0])


def test_max_error_chooses_a_method(half_plane):
    seen, stats = half_plane.visibility(row(), LIGHT, max_error=0.03, stats=True)
    assert stats["method"] == "auto" and stats["options"]["max_error"] == 0.03
    assert stats["decisions"] and stats["milliseconds"]
    expected = shapes.half_plane_fraction(row()[:, 0])
    between = (expected > 0) & (expected < 1)
    assert np.sqrt(np.mean((seen - expected)[between] ** 2)) < 0.03


def test_options_of_the_method_are_keywords(half_plane):
    few, stats = half_plane.visibility(row(), LIGHT, method="reference", samples=4, seed=1, stats=True)
    assert stats["options"] == {"samples": 4, "seed": 1}
    other = half_plane.visibility(row(), LIGHT, method="reference", samples=4, seed=2)
    assert (few != other).any()
    exact = half_plane.visibility(row(), LIGHT, silhouette_tolerance=0.0)
    np.testing.assert_allclose(exact, shapes.half_plane_fraction(row()[:, 0]), atol=CLOSE)


def test_lights_of_a_scene_go_by_number_and_name(half_plane):
    scene = penumbra.Scene(*shapes.plate(half=1000.0, edge_at_0=True))
    scene.lights = [penumbra.DistantLight((0, -1, 0), name="sun"), penumbra.DiskLight((0, 2, 0), (0, -1, 0), 0.5, name="lamp")]
    expected = half_plane.visibility(row(), LIGHT)
    for light in (1, "lamp", scene.lights[1]):
        np.testing.assert_array_equal(scene.visibility(row(), light), expected)
    with pytest.raises(ValueError, match="lamp"):
        scene.visibility(row(), "lamb")
