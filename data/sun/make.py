#!/usr/bin/env python3
"""Writes the city block of `docs/sun.md`: every file of this folder again, the same to the byte.

Lengths are meters; x points east, y up, z south. Houses of three to twelve storeys stand around two courts, a tower beside them.
"""
import json
import os

HERE = os.path.dirname(os.path.abspath(__file__))
# West, east, north, south sides and height; with a sixth number a gable roof of that height whose ridge runs from west to east.
HOUSES = [(-45, -25, -30, -18, 17, 5), (-25, -8, -30.4, -18.3, 20, 5), (-8, 8, -30.2, -17.8, 14, 5), (8, 30, -30.7, -18.5, 23),
          (-44.8, -33, -18, 4, 17), (-4, 6, -17.8, 4.3, 14), (18, 29.7, -18.5, 4.2, 20), (-45, -20, 4, 16, 12, 4), (-20, -4.2, 4.3, 16.4, 15, 4),
          (6.3, 30, 4.2, 16.2, 11, 4), (-14, -8, -10, -4, 4), (40, 54, -10, 4, 38), (40, 60, -34, -20, 12), (42, 58, 14, 24, 9),
          (-40, -10, 28, 40, 16, 5), (-10, 14, 28.5, 40.4, 19, 5), (20, 44, 32, 44, 13)]


def house(west, east, north, south, height, roof=0):
    v = [(x, y, z) for x in (west, east) for y in (0, height) for z in (north, south)]
    f = [(0, 1, 3), (0, 3, 2), (4, 6, 7), (4, 7, 5), (0, 4, 5), (0, 5, 1), (0, 2, 6), (0, 6, 4), (1, 5, 7), (1, 7, 3)]
    if not roof:
        return v, f + [(2, 3, 7), (2, 7, 6)]
    middle = (north + south) / 2
    v += [(west, height + roof, middle), (east, height + roof, middle)]
    return v, f + [(2, 3, 8), (7, 6, 9), (3, 7, 9), (3, 9, 8), (6, 2, 8), (6, 8, 9)]


def write_off(name, vertices, faces):
    with open(f"{HERE}/{name}.off", "w") as out:
        out.write(f"OFF\n{len(vertices)} {len(faces)} 0\n")
        out.writelines("%.17g %.17g %.17g\n" % tuple(v) for v in vertices)
        out.writelines("3 %d %d %d\n" % tuple(f) for f in faces)


vertices, faces = [], []
for sides in HOUSES:
    v, f = house(*sides)
    faces += [[i + len(vertices) for i in triangle] for triangle in f]
    vertices += v
write_off("houses", vertices, faces)
write_off("street", [(-70, 0, -55), (75, 0, -55), (75, 0, 60), (-70, 0, 60)], [(0, 2, 1), (0, 3, 2)])
scene = {"version": 1,
         "lights": [{"shape": "distant", "direction": [0.5, -0.6, -0.62], "angle_degrees": 0.53, "irradiance": [3, 3, 3]}],
         "camera": {"eye": [-90, 95, 120], "target": [2, 0, 2], "up": [0, 1, 0], "fov_y_degrees": 40},
         "objects": [{"mesh": "street.off", "albedo": [0.6, 0.6, 0.6], "casts": False},
                     {"mesh": "houses.off", "albedo": [0.8, 0.72, 0.62]}]}
with open(f"{HERE}/city-block.json", "w") as out:
    out.write(json.dumps(scene, indent=1) + "\n")
