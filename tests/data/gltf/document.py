"""A glTF document under construction, and where its points are in the world: by quaternions as pairs of products q p q*."""
import base64
import json
import math
import pathlib
import struct

# Where files are written; make.py sets it.
FOLDER = pathlib.Path()
CODES = {5120: "b", 5121: "B", 5122: "h", 5123: "H", 5125: "I", 5126: "f"}
TYPES = {1: "SCALAR", 2: "VEC2", 3: "VEC3", 4: "VEC4"}


class File:
    """A document under construction."""

    def __init__(self):
        self.data = b""
        self.json = {"asset": {"version": "2.0"}, "bufferViews": [], "accessors": []}

    def view(self, data, **more):
        self.data += b"\0" * (-len(self.data) % 4)
        self.json["bufferViews"].append({"buffer": 0, "byteOffset": len(self.data), "byteLength": len(data), **more})
        self.data += data
        return len(self.json["bufferViews"]) - 1

    def accessor(self, rows, component, **more):
        per = len(rows[0])
        data = b"".join(struct.pack(f"<{per}{CODES[component]}", *row) for row in rows)
        self.json["accessors"].append({"bufferView": self.view(data), "componentType": component, "count": len(rows),
                                       "type": TYPES[per], **more})
        return len(self.json["accessors"]) - 1

    def positions(self, rows, component=5126, **more):
        return self.accessor(rows, component, min=[min(c) for c in zip(*rows)], max=[max(c) for c in zip(*rows)], **more)

    def indices(self, numbers, component=5123):
        return self.accessor([(n,) for n in numbers], component)

    def scene(self, nodes, roots, meshes, **more):
        self.json |= {"scene": 0, "scenes": [{"nodes": roots}], "nodes": nodes, "meshes": meshes, **more}

    def tent(self, **more):
        """A mesh of the tent below."""
        return {"primitives": [{"attributes": {"POSITION": self.positions(TENT)},
                                "indices": self.indices([i for t in TENT_FACES for i in t]), **more}]}

    def write_gltf(self, name, uri=None):
        if uri:
            (FOLDER / uri).write_bytes(self.data)
        self.json["buffers"] = [{"byteLength": len(self.data), "uri": uri or
                                 "data:application/octet-stream;base64," + base64.b64encode(self.data).decode()}]
        (FOLDER / name).write_text(json.dumps(self.json) + "\n")

    def write_glb(self, name):
        self.data += b"\0" * (-len(self.data) % 4)
        self.json["buffers"] = [{"byteLength": len(self.data)}]
        text = json.dumps(self.json).encode()
        text += b" " * (-len(text) % 4)
        (FOLDER / name).write_bytes(struct.pack("<4sII", b"glTF", 2, 28 + len(text) + len(self.data)) +
                                  struct.pack("<II", len(text), 0x4E4F534A) + text +
                                  struct.pack("<II", len(self.data), 0x004E4942) + self.data)


def hamilton(a, b):
    ax, ay, az, aw = a
    bx, by, bz, bw = b
    return (aw * bx + ax * bw + ay * bz - az * by, aw * by - ax * bz + ay * bw + az * bx,
            aw * bz + ax * by - ay * bx + az * bw, aw * bw - ax * bx - ay * by - az * bz)


def placed(p, node):
    """One node's own transform."""
    if "matrix" in node:
        m = node["matrix"]
        return tuple(m[i] * p[0] + m[4 + i] * p[1] + m[8 + i] * p[2] + m[12 + i] for i in range(3))
    p = [a * b for a, b in zip(p, node.get("scale", (1, 1, 1)))]
    q = node.get("rotation", (0, 0, 0, 1))
    x, y, z, _ = hamilton(hamilton(q, (*p, 0)), (-q[0], -q[1], -q[2], q[3]))
    return tuple(a + b for a, b in zip((x, y, z), node.get("translation", (0, 0, 0))))


def world(p, *nodes):
    """Nodes from the child up."""
    for node in nodes:
        p = placed(p, node)
    return p


def mirrored(*nodes):
    o, x, y, z = (world(p, *nodes) for p in ((0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)))
    a, b, c = ([s - t for s, t in zip(v, o)] for v in (x, y, z))
    return sum(a[i] * (b[(i + 1) % 3] * c[(i + 2) % 3] - b[(i + 2) % 3] * c[(i + 1) % 3]) for i in range(3)) < 0


def triangles(points, corners, *nodes):
    flip = mirrored(*nodes)
    out = []
    for a, b, c in corners:
        a, b, c = (world(points[i], *nodes) for i in ((a, c, b) if flip else (a, b, c)))
        out.append([*a, *b, *c])
    return out


def expect(name, objects, **more):
    (FOLDER / f"{name}.expected.json").write_text(json.dumps({"objects": objects, **more}, indent=1) + "\n")


def exact(rows):
    """As single precision has them."""
    return [struct.unpack(f"<{len(r)}f", struct.pack(f"<{len(r)}f", *r)) for r in rows]


def turned(axis, degrees):
    s, c = math.sin(math.radians(degrees) / 2), math.cos(math.radians(degrees) / 2)
    n = math.sqrt(sum(a * a for a in axis))
    return [s * axis[0] / n, s * axis[1] / n, s * axis[2] / n, c]


TENT = [(0.0, 0.0, 0.0), (1.0, 0.0, 0.0), (0.0, 0.0, 2.0), (0.25, 1.5, 0.5)]
TENT_FACES = [(0, 1, 2), (0, 3, 1), (1, 3, 2), (2, 3, 0)]
