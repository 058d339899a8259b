"""Hours of sun on the street of a city block over one day, and when one of its windows is lit.

usage: hours_map.py [SCENE] [--size N] [--date YYYY-MM-DD] [--minutes M] [--output PICTURE.png]

x points east, y up, z south.
"""
import argparse

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
import penumbra

PLACE = (52.5, 13.4)  # latitude, longitude
WINDOW, LOOKS = (-15.0, 1.6, -17.95), (0.0, 0.0, 1.0)
EVENTS = ("first light", "full light", "first shade", "last light")


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("scene", nargs="?", default="data/sun/city-block.json")
    parser.add_argument("--size", type=int, default=300, help="points along a side")
    parser.add_argument("--date", default="2026-04-15")
    parser.add_argument("--minutes", type=int, default=10, help="from sun to sun")
    parser.add_argument("--output", default="hours_map.png")
    arguments = parser.parse_args()

    scene = penumbra.Scene.from_file(arguments.scene)
    day = np.datetime64(arguments.date, "m")
    times = day + np.arange(0, 24 * 60 + 1, arguments.minutes)
    (west, _, north), (east, _, south) = scene.bounds
    x, z = np.meshgrid(np.linspace(west, east, arguments.size), np.linspace(north, south, arguments.size))
    street = np.stack([x, np.zeros_like(x), z], axis=-1)
    seen = scene.sun(street, times, *PLACE, np.broadcast_to([0.0, 1.0, 0.0], street.shape))
    hours = np.trapz(seen, dx=arguments.minutes / 60, axis=0)
    print(f"street: {hours.min():.2f} to {hours.max():.2f} hours of sun, mean {hours.mean():.2f}")

    _, contacts = scene.sun([WINDOW], times, *PLACE, [LOOKS], contacts=True)
    for time, event in zip(contacts["time"], contacts["event"]):
        print(f"window: {EVENTS[event]} at {np.datetime64(round(time), 's')} UTC")

    figure, axes = plt.subplots(figsize=(8, 6.4), layout="constrained")
    shown = axes.imshow(hours, extent=(west, east, south, north), cmap="inferno", vmin=0)
    axes.plot(WINDOW[0], WINDOW[2], "c^")
    axes.set(title=f"Hours of sun, {arguments.date}, {PLACE[0]}° north", xlabel="east, m", ylabel="south, m")
    figure.colorbar(shown, ax=axes, label="hours")
    figure.savefig(arguments.output, dpi=110)


main()
