"""How large must a lamp be for soft shadows? A bunny on a table below lamps of four sizes.

usage: lamp_design.py MESH [--size N] [--output PICTURE.png]
"""
import argparse

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
import penumbra

RADII = (0.02, 0.05, 0.10, 0.20)  # meters


def table(size):
    """Points of a square table, 1 m wide, and its normals."""
    x, z = np.meshgrid(np.linspace(-0.5, 0.5, size), np.linspace(-0.5, 0.5, size))
    points = np.stack([x, np.zeros_like(x), z], axis=-1)
    return points, np.broadcast_to([0.0, 1.0, 0.0], points.shape)


def standing_on_the_table(path, height=0.3):
    """The mesh of a file, `height` meters tall."""
    loaded = penumbra.Scene.from_file(path)
    V, F = loaded.mesh(len(loaded) - 1)
    low, high = V.min(axis=0), V.max(axis=0)
    middle = [(low[0] + high[0]) / 2, low[1], (low[2] + high[2]) / 2]
    return (V - middle) * (height / (high[1] - low[1])), F


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("mesh")
    parser.add_argument("--size", type=int, default=400, help="points along each side of the table")
    parser.add_argument("--output", default="lamp_design.png")
    arguments = parser.parse_args()

    scene = penumbra.Scene(*standing_on_the_table(arguments.mesh))
    points, normals = table(arguments.size)
    figure, panels = plt.subplots(1, len(RADII), figsize=(3 * len(RADII), 3.4), layout="constrained")
    print("radius of the lamp   umbra   penumbra   (shares of the table)")
    for radius, panel in zip(RADII, panels):
        lamp = penumbra.DiskLight(center=(-0.6, 1.0, -0.3), normal=(0.6, -1.0, 0.3), radius=radius)
        seen = scene.visibility(points, lamp, normals)
        print(f"{100 * radius:15.0f} cm {np.mean(seen == 0):8.2%} {np.mean((seen > 0) & (seen < 1)):9.2%}")
        panel.imshow(seen, cmap="gray", vmin=0, vmax=1, extent=(-0.5, 0.5, 0.5, -0.5))
        panel.contour(seen, levels=[0.1, 0.5, 0.9], colors=["#2b6cb0", "#dd6b20", "#b7791f"], linewidths=0.8,
                      extent=(-0.5, 0.5, -0.5, 0.5))
        panel.set_title(f"radius {100 * radius:.0f} cm")
        panel.set_xlabel("m")
        panel.tick_params(labelleft=panel is panels[0])
    figure.suptitle("Share of the lamp that the table sees; lines at 10%, 50% and 90%")
    figure.savefig(arguments.output, dpi=110)


main()
