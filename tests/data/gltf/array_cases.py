"""How arrays are kept: indices of every size or none, buffers of their own, strides, small integers, sparse values."""
import base64
import json
import math
import struct

import document
from document import TENT, TENT_FACES, File, exact, expect, triangles

FLAT = [i for t in TENT_FACES for i in t]


def indices():
    """The same tent by indices of 8, 16 and 32 bits."""
    f = File()
    points = f.positions(TENT)
    sizes = {"bytes": 5121, "shorts": 5123, "words": 5125}
    nodes = [{"name": name, "mesh": k, "translation": [3 * k, 0, 0]} for k, name in enumerate(sizes)]
    f.scene(nodes, [0, 1, 2], [{"primitives": [{"attributes": {"POSITION": points}, "indices": f.indices(FLAT, size)}]} for size in sizes.values()])
    f.write_gltf("indices.gltf")
    expect("indices", [{"name": node["name"], "triangles": triangles(TENT, TENT_FACES, node)} for node in nodes])


def unindexed():
    """Lists, a strip and a fan without indices, below a node that mirrors; vertices that fill no triangle are left over."""
    f = File()
    soup = [TENT[i] for i in FLAT]
    row = exact([(k, (k % 2) * 1.5, 0.3 * k * k) for k in range(6)])
    fan = exact([(0.0, 0.0, -4.0)] + [(math.sin(k), 2 * math.cos(k), -4.0 - 0.1 * k) for k in range(4)])
    node = {"name": "soup", "mesh": 0, "scale": [1, 1, -1]}
    f.scene([node], [0], [{"primitives": [{"attributes": {"POSITION": f.positions(soup + [(9.0, 9.0, 9.0)])}},
                                          {"mode": 5, "attributes": {"POSITION": f.positions(row)}},
                                          {"mode": 6, "attributes": {"POSITION": f.positions(fan)}}]}])
    f.write_glb("unindexed.glb")
    odd_turned = [(k, k + 1, k + 2) if k % 2 == 0 else (k + 1, k, k + 2) for k in range(4)]
    expect("unindexed", [{"name": "soup", "triangles": triangles(soup, [(3 * k, 3 * k + 1, 3 * k + 2) for k in range(4)], node) +
                          triangles(row, odd_turned, node) + triangles(fan, [(0, k, k + 1) for k in (1, 2, 3)], node)}])


def buffers():
    """Positions in a file beside it, indices in the text."""
    places, corners = struct.pack("<12f", *(c for p in TENT for c in p)), struct.pack("<12H", *FLAT)
    (document.FOLDER / "buffers positions.bin").write_bytes(places)
    low, high = [min(c) for c in zip(*TENT)], [max(c) for c in zip(*TENT)]
    text = {"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"name": "tent", "mesh": 0}],
                "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
                "buffers": [{"byteLength": len(places), "uri": "buffers%20positions.bin"},
                            {"byteLength": len(corners), "uri": "data:application/gltf-buffer;base64," + base64.b64encode(corners).decode()}],
                "bufferViews": [{"buffer": 0, "byteLength": len(places)}, {"buffer": 1, "byteLength": len(corners)}],
                "accessors": [{"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3", "min": low, "max": high},
                              {"bufferView": 1, "componentType": 5123, "count": 12, "type": "SCALAR"}]}
    (document.FOLDER / "buffers.gltf").write_text(json.dumps(text) + "\n")
    expect("buffers", [{"name": "tent", "triangles": triangles(TENT, TENT_FACES)}])


def quantized():
    """KHR_mesh_quantization: positions of 8 and 16 bits, with a sign and without, normalized and not; the least integer means -1, too."""
    f = File()
    kinds = {"bytes": (5120, False, 1), "unit_bytes": (5120, True, 127), "ubytes": (5121, False, 1), "unit_ubytes": (5121, True, 255),
             "shorts": (5122, False, 1), "unit_shorts": (5122, True, 32767), "ushorts": (5123, False, 1), "unit_ushorts": (5123, True, 65535)}
    meshes, nodes, objects = [], [], []
    for k, (name, (component, normalized, one)) in enumerate(kinds.items()):
        signed, most = component in (5120, 5122), 127 if component < 5122 else 32767
        points = [(0, 0, 0), (most, 0, 0), (0, 0, most - 7), (most // 3, most - 1, -most - 1 if signed else 5)]
        rows = b"".join(struct.pack(f"<3{'bBhH'[component - 5120]}", *p).ljust(4 if component < 5122 else 8, b"\0") for p in points)
        accessor = {"bufferView": f.view(rows, byteStride=4 if component < 5122 else 8, target=34962), "componentType": component, "count": 4, "type": "VEC3",
                    "min": [min(c) for c in zip(*points)], "max": [max(c) for c in zip(*points)]}
        f.json["accessors"].append(accessor | ({"normalized": True} if normalized else {}))
        meshes.append({"primitives": [{"attributes": {"POSITION": len(f.json["accessors"]) - 1}, "indices": f.indices([i for t in TENT_FACES for i in t])}]})
        nodes.append({"name": name, "mesh": k, "translation": [2 * k, 0, 0], "scale": [1.25 if normalized else 1 / 64] * 3})
        objects.append({"name": name, "triangles": triangles([[max(c / one, -1) if normalized else c for c in p] for p in points], TENT_FACES, nodes[-1])})
    f.scene(nodes, list(range(len(nodes))), meshes, extensionsUsed=["KHR_mesh_quantization"], extensionsRequired=["KHR_mesh_quantization"])
    f.write_glb("quantized.glb")
    expect("quantized", objects)


def interleaved():
    """Positions, normals and texture places of a vertex side by side, behind a head that belongs to none; indices start inside their view."""
    f = File()
    normals = exact([(0.0, 1.0, 0.0), (0.6, 0.8, 0.0), (0.0, 0.6, 0.8), (-0.6, 0.0, 0.8)])
    data = b"head" + b"".join(struct.pack("<3f3f2f", *p, *n, 0.5, 0.25) for p, n in zip(TENT, normals))
    view = f.view(data, byteStride=32, target=34962)
    for offset, kind, more in ((4, "VEC3", {"min": [min(c) for c in zip(*TENT)], "max": [max(c) for c in zip(*TENT)]}), (16, "VEC3", {}), (28, "VEC2", {})):
        f.json["accessors"].append({"bufferView": view, "byteOffset": offset, "componentType": 5126, "count": 4, "type": kind, **more})
    corners = f.view(struct.pack("<15H", 99, 99, 99, *FLAT))
    f.json["accessors"].append({"bufferView": corners, "byteOffset": 6, "componentType": 5123, "count": 12, "type": "SCALAR"})
    f.scene([{"name": "tent", "mesh": 0}], [0], [{"primitives": [{"attributes": {"POSITION": 0, "NORMAL": 1, "TEXCOORD_0": 2}, "indices": 3}]}])
    f.write_glb("interleaved.glb")
    expect("interleaved", [{"name": "tent", "triangles": triangles(TENT, TENT_FACES), "normals": [[normals[i] for i in t] for t in TENT_FACES]}])


def sparse():
    """Sparse values over zeros, by indices of 16 bits, and over a view, by 32 bits; the last of each is an element's last."""
    f = File()
    points = [TENT[0], TENT[1], TENT[2], TENT[3]]
    f.json["accessors"].append({"componentType": 5126, "count": 4, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1.5, 2], "sparse": {
        "count": 3, "indices": {"bufferView": f.view(struct.pack("<3H", 1, 2, 3)), "componentType": 5123},
        "values": {"bufferView": f.view(struct.pack("<9f", *(c for p in points[1:] for c in p)))}}})
    moved = f.positions(TENT, sparse={"count": 1, "indices": {"bufferView": f.view(struct.pack("<2I", 7, 3)), "byteOffset": 4, "componentType": 5125},
                                      "values": {"bufferView": f.view(struct.pack("<6f", 9, 9, 9, 0.5, 4, 0.25)), "byteOffset": 12}})
    f.json["accessors"][moved]["max"] = [1, 4, 2]
    corners = f.indices(FLAT)
    f.scene([{"name": "zeros", "mesh": 0}, {"name": "moved", "mesh": 1, "translation": [0, 0, 5]}], [0, 1],
            [{"primitives": [{"attributes": {"POSITION": p}, "indices": corners}]} for p in (0, moved)])
    f.write_gltf("sparse.gltf")
    expect("sparse", [{"name": "zeros", "triangles": triangles(points, TENT_FACES)},
                      {"name": "moved", "triangles": triangles(TENT[:3] + [(0.5, 4, 0.25)], TENT_FACES, {"translation": [0, 0, 5]})}])


def texture_places():
    """Two sets of texture coordinates, the second of normalized 16-bit numbers, under a node that mirrors; beside it a primitive with the first alone."""
    f = File()
    rows = [(0, 0), (65535, 0), (0, 65535), (13107, 26214)]
    tent, bare = f.tent(), f.tent()
    first = f.accessor([(2.0, -3.0)] * 4, 5126)
    tent["primitives"][0]["attributes"] |= {"TEXCOORD_0": first, "TEXCOORD_1": f.accessor(rows, 5123, normalized=True)}
    bare["primitives"][0]["attributes"] |= {"TEXCOORD_0": first}
    node = {"name": "tent", "mesh": 0, "scale": [-1, 1, 1]}
    f.scene([node], [0], [{"primitives": tent["primitives"] + bare["primitives"]}])
    f.write_glb("texture_places.glb")
    order = [(a, c, b) for a, b, c in TENT_FACES]
    expect("texture_places", [{"name": "tent", "triangles": 2 * triangles(TENT, TENT_FACES, node),
                               "uv": [[[x / 65535 for x in rows[i]] for i in t] for t in order] + [None] * len(order)}])


CASES = (texture_places, indices, unindexed, buffers, quantized, interleaved, sparse)
