"""The sun: positions, contacts, several lights at once."""
import numpy as np
import penumbra
import pytest
import shapes

BERLIN = (52.5, 13.4)
DAY = np.arange("2026-03-20T00:00", "2026-03-21T00:20", 20, dtype="datetime64[m]")


def test_the_example_of_the_solar_position_algorithm():
    azimuth, elevation, radius = penumbra.sun_position(np.datetime64("2003-10-17T19:30:30"), 39.742476, -105.1786, pressure=820,
                                                       temperature=11)
    assert azimuth.shape == () and radius == pytest.approx(959.63 / 3600 / 0.99654, abs=1e-5)
    assert elevation == pytest.approx(90 - 50.11162, abs=2e-4)
    assert azimuth == pytest.approx(194.34024, abs=1e-3)
    same = penumbra.sun_position([1066419030.0], 39.742476, -105.1786, pressure=820, temperature=11)
    assert same[0].shape == (1,) and same[0][0] == azimuth


def test_the_light_shines_from_the_sun():
    azimuth, elevation, radius = np.radians(penumbra.sun_position(DAY[36], *BERLIN))
    sun = penumbra.sun_light(DAY[36], *BERLIN, up=(0, 0, 1), north=(0, 1, 0))
    np.testing.assert_allclose(sun.direction, [-np.sin(azimuth) * np.cos(elevation), -np.cos(azimuth) * np.cos(elevation),
                                               -np.sin(elevation)], atol=1e-12)
    assert sun.angle_degrees == pytest.approx(2 * np.degrees(radius))


def test_a_list_of_lights_is_one_more_axis():
    scene = penumbra.Scene(*shapes.box())
    x = np.linspace(-2, 2, 12)
    points = np.stack(np.meshgrid(x, [0.0], x), axis=-1)
    lights = [penumbra.DistantLight((d, -1, 0.2), 5.0) for d in (-0.5, 0.0, 0.5)] + [penumbra.DiskLight((0, 4, 0), (0, -1, 0), 1.0)]
    seen, region, stats = scene.visibility(points, lights, region=True, stats=True)
    assert seen.shape == region.shape == (4, *points.shape[:-1]) and len(stats) == 4
    for k, light in enumerate(lights):
        np.testing.assert_array_equal(seen[k], scene.visibility(points, light))
    assert scene.visibility(points, lights[:1]).shape == (1, *points.shape[:-1])
    assert scene.visibility(points, []).shape == (0, *points.shape[:-1])


def test_contacts_lie_between_the_times_that_they_divide():
    scene = penumbra.Scene(*shapes.box((0.0, 1.0, 2.0), 1.0))  # south of the points
    points, normals = np.array([[0.0, 0, -0.5], [50.0, 0, 0]]), np.array([[0.0, 1, 0]] * 2)
    seen, contacts = scene.sun(points, DAY, *BERLIN, normals, contacts=True)
    assert seen.shape == (len(DAY), 2) and seen.dtype == np.float32
    assert seen[0].tolist() == [0, 0] and seen[36, 1] == 1
    of_open = contacts["event"][contacts["receiver"] == 1]
    assert of_open.tolist() == [0, 1, 2, 3]
    assert len(contacts["event"]) > 8  # the box's shadow passes
    seconds = DAY.astype("datetime64[s]").astype(float)
    for receiver, time, event in zip(*(contacts[k] for k in ("receiver", "time", "event"))):
        k = np.searchsorted(seconds, time)
        before, after = seen[k - 1, receiver], seen[k, receiver]
        assert {0: before == 0 < after, 1: before < 1 == after, 2: before == 1 > after, 3: before > 0 == after}[int(event)]


@pytest.mark.parametrize("change, says", [
    (dict(times=DAY[::-1]), "sort"), (dict(times=[["2026-01-01"]]), "type"), (dict(times=[np.datetime64("NaT")]), "NaT"),
    (dict(latitude=99.0), "latitude"), (dict(up=(0, 0, 0)), "axes"), (dict(normals=[0, 1]), "normals"), (dict(times=DAY[0]), "row")])
def test_complaints(change, says):
    scene = penumbra.Scene(*shapes.box())
    arguments = dict(points=[[0.0, 0, 0]], times=DAY, latitude=52.5, longitude=13.4, contacts=True) | change
    with pytest.raises((ValueError, TypeError), match=says):
        scene.sun(**arguments)
