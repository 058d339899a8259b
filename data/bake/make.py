#!/usr/bin/env python3
"""Writes the room of `docs/bake.md`: every file of this folder again, the same to the byte.

Lengths are meters; y points up. The room is 6 wide, 4 deep and 3 high, open to the front, where the camera stands. In it are a table, a
ball on the table, a column and a shelf on the wall. Three lamps: one below the ceiling, a panel on the left wall, a small one above the column.
"""
import json
import math
import os

HERE = os.path.dirname(os.path.abspath(__file__))


def box(low, high):
    v = [(x, y, z) for x in (low[0], high[0]) for y in (low[1], high[1]) for z in (low[2], high[2])]
    return v, [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]


def ball(center, radius, rings, sides):
    x, y, z = center
    v = [(x, y + radius, z), (x, y - radius, z)]
    for i in range(1, rings):
        a = math.pi * i / rings
        v += [(x + radius * math.sin(a) * math.cos(b), y + radius * math.cos(a), z + radius * math.sin(a) * math.sin(b))
              for b in (2 * math.pi * k / sides for k in range(sides))]
    at = lambda i, k: 2 + (i - 1) * sides + k % sides
    f = [(0, at(1, k + 1), at(1, k)) for k in range(sides)] + [(1, at(rings - 1, k), at(rings - 1, k + 1)) for k in range(sides)]
    return v, f + [(at(i, k), at(i, k + 1), at(i + 1, k + 1), at(i + 1, k)) for i in range(1, rings - 1) for k in range(sides)]


def column(center, radius, height, sides):
    x, y, z = center
    ring = [(radius * math.cos(2 * math.pi * k / sides), radius * math.sin(2 * math.pi * k / sides)) for k in range(sides)]
    v = [(x + a, h, z + b) for h in (y, y + height) for a, b in ring]
    f = [(k, sides + k, sides + (k + 1) % sides, (k + 1) % sides) for k in range(sides)]
    return v, f + [tuple(range(sides)), tuple(range(2 * sides - 1, sides - 1, -1))]


def joined(*parts):
    vertices, faces = [], []
    for v, f in parts:
        faces += [[i + len(vertices) for i in face] for face in f]
        vertices += v
    return vertices, faces


def write_off(name, mesh):
    vertices, faces = mesh
    with open(f"{HERE}/{name}.off", "w") as out:
        out.write(f"OFF\n{len(vertices)} {len(faces)} 0\n")
        out.writelines("%.6g %.6g %.6g\n" % tuple(v) for v in vertices)
        out.writelines(" ".join(map(str, (len(f), *f))) + "\n" for f in faces)


corners, sides = box((-3, 0, -2), (3, 3, 2))
write_off("room", (corners, [face[::-1] for face in sides[:5]]))  # all but the front, seen from inside
legs = [box((x, 0, z), (x + .08, .72, z + .08)) for x in (-1.5, .02) for z in (-.5, .42)]
write_off("table", joined(box((-1.6, .72, -.6), (.2, .78, .6)), *legs))
write_off("ball", ball((-.7, 1.03, 0), .25, 12, 24))
write_off("column", column((1.7, 0, -.6), .3, 1.9, 24))
write_off("shelf", joined(box((-.6, 1.5, -2), (1, 1.55, -1.7)), box((-.45, 1.55, -1.95), (-.3, 1.85, -1.75)), box((.1, 1.55, -1.95), (.4, 1.7, -1.75))))
lights = [{"name": "ceiling", "shape": "disk", "center": [-.4, 2.95, .2], "normal": [0, -1, 0], "radius": .3, "radiance": [14, 12.5, 10]},
          {"name": "panel", "shape": "disk", "center": [-2.95, 1.6, .4], "normal": [1, 0, 0], "radius": .5, "radiance": [2, 2.6, 4]},
          {"name": "spot", "shape": "disk", "center": [2.3, 2.6, .9], "normal": [-.5, -1, -.9], "radius": .08, "radiance": [90, 60, 40]}]
scene = {"version": 1, "lights": lights,
         "camera": {"eye": [.6, 1.9, 6.6], "target": [0, 1.3, 0], "up": [0, 1, 0], "fov_y_degrees": 42},
         "objects": [{"mesh": "room.off", "albedo": [.75, .73, .7]}, {"mesh": "table.off", "albedo": [.6, .42, .28]},
                     {"mesh": "ball.off", "albedo": [.8, .8, .8]}, {"mesh": "column.off", "albedo": [.7, .7, .72]},
                     {"mesh": "shelf.off", "albedo": [.5, .55, .45]}]}
with open(f"{HERE}/room.json", "w") as out:
    out.write(json.dumps(scene, indent=1) + "\n")
