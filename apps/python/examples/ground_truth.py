"""Shadows by 64 rays a point beside exact ones: what noise looks like, and how large it is.

usage: ground_truth.py SCENE [--size N] [--rays N] [--output PICTURE.png]
"""
import argparse

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
import penumbra


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("scene")
    parser.add_argument("--size", type=int, default=480, help="width of the pictures, pixels")
    parser.add_argument("--rays", type=int, default=64, help="a point")
    parser.add_argument("--output", default="ground_truth.png")
    arguments = parser.parse_args()

    size = (arguments.size, arguments.size * 3 // 4)
    exact = penumbra.render(arguments.scene, size=size)
    sampled = penumbra.render(arguments.scene, "reference", size=size, samples=arguments.rays)
    difference = sampled["visibility"] - exact["visibility"]
    partly = (exact["A"] > 0) & (exact["visibility"] > 0) & (exact["visibility"] < 1)
    rmse = np.sqrt(np.mean(difference[partly] ** 2))
    print(f"{arguments.rays} rays differ by an RMSE of {rmse:.4f} over {partly.sum()} pixels in penumbra, "
          f"at most by {np.abs(difference).max():.3f}")

    figure, panels = plt.subplots(1, 3, figsize=(13, 3.9), layout="constrained")
    for panel, picture, title in zip(panels, (exact, sampled), ("exact areas", f"{arguments.rays} rays")):
        panel.imshow(picture["visibility"], cmap="gray", vmin=0, vmax=1)
        panel.set_title(f"visibility by {title}")
    most = 4 * max(rmse, 1e-6)
    shown = panels[2].imshow(difference, cmap="RdBu", vmin=-most, vmax=most)
    panels[2].set_title(f"difference, RMSE {rmse:.3f} in penumbra")
    figure.colorbar(shown, ax=panels[2])
    for panel in panels:
        panel.set_axis_off()
    figure.savefig(arguments.output, dpi=110)


main()
