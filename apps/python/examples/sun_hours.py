"""Hours of sun on a facade and on the street before it, on an equinox in Berlin.

usage: sun_hours.py [--size N] [--minutes M] [--output PICTURE.png]

x points east, y up, z south. The sun is where the equations of a circular orbit put it; hours are solar time.
"""
import argparse

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
import penumbra

LATITUDE, DECLINATION = np.radians(52.5), 0.0
SUN = 0.53  # degrees
# Of buildings: west, east, north, south, height in meters. The first one's south side is looked at.
BUILDINGS = [(-20, 20, -12, 0, 18), (-30, -12, 16, 30, 12), (-8, 4, 16, 30, 27), (9, 30, 16, 30, 15), (26, 40, -12, 0, 22)]
BOX = np.array([[0, 1, 3], [0, 3, 2], [4, 6, 7], [4, 7, 5], [0, 4, 5], [0, 5, 1], [2, 3, 7], [2, 7, 6], [0, 2, 6], [0, 6, 4],
                [1, 5, 7], [1, 7, 3]])
SOUTH = (10, 11)  # rows of BOX: the side towards +z


def box(west, east, north, south, height):
    return np.array([[x, y, z] for x in (west, east) for y in (0, height) for z in (north, south)], float)


def to_the_sun(hour):
    """Unit vector towards the sun at an hour of solar time."""
    angle = np.radians(15.0 * (hour - 12.0))
    up = np.sin(LATITUDE) * np.sin(DECLINATION) + np.cos(LATITUDE) * np.cos(DECLINATION) * np.cos(angle)
    west = np.cos(DECLINATION) * np.sin(angle)
    south = np.sin(LATITUDE) * np.cos(DECLINATION) * np.cos(angle) - np.cos(LATITUDE) * np.sin(DECLINATION)
    return np.array([-west, up, south])


def sunlit_hours(scene, points, normal, step, **on):
    """The time for which each point sees the sun, hours: a half-hidden sun counts as half."""
    hours, normals = np.zeros(points.shape[:-1]), np.broadcast_to(normal, points.shape)
    for hour in np.arange(6.0 + step / 2, 18.0, step):
        sun = penumbra.DistantLight(-to_the_sun(hour), SUN)
        hours += step * scene.visibility(points, sun, normals, **on)
    return hours


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--size", type=int, default=160, help="points along the facade")
    parser.add_argument("--minutes", type=float, default=10.0, help="from sun to sun")
    parser.add_argument("--output", default="sun_hours.png")
    arguments = parser.parse_args()

    scene = penumbra.Scene()
    for sides in BUILDINGS:
        scene.add(box(*sides), BOX)
    west, east, _, south, height = BUILDINGS[0]
    x, y = np.meshgrid(np.linspace(west, east, arguments.size), np.linspace(0, height, max(2, arguments.size // 2)))
    facade = np.stack([x, y, np.full_like(x, south)], axis=-1)
    x, z = np.meshgrid(np.linspace(west, east, arguments.size), np.linspace(south, 16, max(2, arguments.size // 2)))
    street = np.stack([x, np.zeros_like(x), z], axis=-1)

    step = arguments.minutes / 60
    # The facade's points lie on a building: its own plane hides nothing from them.
    on_facade = sunlit_hours(scene, facade, (0, 0, 1), step, objects=0, faces=SOUTH[0])
    on_street = sunlit_hours(scene, street, (0, 1, 0), step)
    print(f"facade: {on_facade.min():.2f} to {on_facade.max():.2f} hours of sun, mean {on_facade.mean():.2f}")
    print(f"street: {on_street.min():.2f} to {on_street.max():.2f} hours of sun, mean {on_street.mean():.2f}")

    figure, panels = plt.subplots(2, 1, figsize=(8, 7), layout="constrained")
    options = dict(cmap="inferno", vmin=0, vmax=12)
    shown = panels[0].imshow(on_facade, origin="lower", extent=(west, east, 0, height), **options)
    panels[0].set(title="Facade, seen from the south", ylabel="height, m")
    panels[1].imshow(on_street, extent=(west, east, 16, south), **options)
    panels[1].set(title="Street, seen from above", xlabel="east, m", ylabel="south, m")
    figure.colorbar(shown, ax=panels, label="hours of sun on an equinox")
    figure.savefig(arguments.output, dpi=110)


main()
