"""A tree of nodes, strips, packed arrays, instances."""
import math
import struct

from document import TENT, TENT_FACES, File, expect, triangles, turned, exact


def nodes():
    """A tree of nodes by TRS and by matrix, one of which mirrors; a camera, three lights, base colors, and what is ignored."""
    f = File()
    mesh = {"primitives": [{"attributes": {"POSITION": f.positions(TENT)},
                            "indices": f.indices([i for t in TENT_FACES for i in t]), "material": 0}]}
    parent = {"translation": [3.0, -1.0, 0.5], "rotation": turned((1, 2, 3), 40), "scale": [2.0, 0.5, 1.5]}
    child = {"name": "child", "mesh": 0, "rotation": turned((0, 1, 0), -75), "translation": [0.0, 4.0, 0.0]}
    mirror = {"name": "mirror", "mesh": 0, "matrix": [0, 0, 1, 0, 0, 1, 0, 0, 1.5, 0, 0, 0, -2, 0, 7, 1]}
    camera = {"camera": 0, "translation": [1.0, 2.0, 9.0], "rotation": turned((0, 1, 0), 90)}
    sun = {"rotation": turned((1, 0, 0), -90), "extensions": {"KHR_lights_punctual": {"light": 0}}}
    lamp = {"translation": [0, 8, 0], "rotation": turned((1, 0, 0), -90), "extensions": {"KHR_lights_punctual": {"light": 1}}}
    bulb = {"translation": [0, 9, 0], "extras": {"radius": 0.125}, "extensions": {"KHR_lights_punctual": {"light": 2}}}
    f.json |= {"scene": 0, "scenes": [{"nodes": [0, 2, 3, 4, 5, 6]}], "meshes": [mesh],
               "nodes": [parent | {"children": [1]}, child, mirror, camera, sun, lamp, bulb],
               "materials": [{"name": "red", "pbrMetallicRoughness": {"baseColorFactor": [0.8, 0.1, 0.05, 1.0], "baseColorTexture": {"index": 0}}}],
               "textures": [{"source": 0}], "images": [{"uri": "missing.png"}],
               "cameras": [{"type": "perspective", "perspective": {"yfov": math.radians(35), "znear": 0.1}}],
               "extensionsUsed": ["KHR_lights_punctual", "KHR_materials_clearcoat"],
               "extensions": {"KHR_lights_punctual": {"lights": [
                   {"type": "directional", "intensity": 3.0, "extras": {"angle_degrees": 2.0}},
                   {"type": "spot", "name": "lamp one", "intensity": 10.0, "color": [1, 0.5, 0.25], "extras": {"radius": 0.5}, "spot": {}},
                   {"type": "point", "intensity": 5.0}]}}}
    f.write_gltf("nodes.gltf")
    color = [0.8, 0.1, 0.05]
    expect("nodes", [{"name": "child", "albedo": color, "triangles": triangles(TENT, TENT_FACES, child, parent)},
                     {"name": "mirror", "albedo": color, "triangles": triangles(TENT, TENT_FACES, mirror)}],
           camera={"eye": [1, 2, 9], "towards": [-1, 0, 0], "fov_y_degrees": 35},
           lights=[{"name": "light", "direction": [0, -1, 0], "angle_degrees": 2.0},
                   {"name": "lamp-one", "center": [0, 8, 0], "normal": [0, -1, 0], "radius": 0.5,
                    "radiance": [c * 10 / (math.pi * 0.25) for c in (1, 0.5, 0.25)]},
                   {"name": "light-1", "center": [0, 9, 0], "radius": 0.125}],
           ignored=["textures", "cones of spot lights", "extension KHR_materials_clearcoat"])


def strips():
    """A strip, a fan, a list without indices; points are left out. A .glb."""
    f = File()
    row = [(float(i // 2), float(i % 2), 0.1 * i) for i in range(7)]
    wheel = [(0.0, 0.0, 3.0)] + [(math.cos(k), math.sin(k), 3.0) for k in range(5)]
    loose = [(float(k), 0.5 * k * k, -1.0 - k % 2) for k in range(6)]
    f.json |= {"scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}], "materials": [{"pbrMetallicRoughness": {"baseColorFactor": [0, 1, 0, 1]}}],
               "meshes": [{"name": "pieces", "primitives": [
                   {"mode": 5, "attributes": {"POSITION": f.positions(row)}, "indices": f.indices(range(7), 5121), "material": 0},
                   {"mode": 6, "attributes": {"POSITION": f.positions(wheel)}},
                   {"attributes": {"POSITION": f.positions(loose)}},
                   {"mode": 0, "attributes": {"POSITION": f.positions(loose)}}]}]}
    f.write_glb("strips.glb")
    strip = [(i, i + 1, i + 2) if i % 2 == 0 else (i, i + 2, i + 1) for i in range(5)]
    expect("strips", [{"name": "pieces", "triangles": triangles(exact(row), strip) + triangles(exact(wheel), [(k, k + 1, 0) for k in range(1, 5)]) +
                       triangles(exact(loose), [(0, 1, 2), (3, 4, 5)])}], ignored=["points and lines"])


def packed():
    """Quantized and interleaved positions in a file of their own, sparse values, 32-bit indices."""
    f = File()
    tent = [(a, c, b) for a, b, c in TENT_FACES]  # the places below mirror it
    short = [(0, 0, 0), (32767, 0, 0), (0, 0, -32767), (-16384, 20000, 5)]
    data = b"".join(struct.pack("<3hh", *p, 99) for p in short)
    f.json["accessors"].append({"bufferView": f.view(data, byteStride=8), "componentType": 5122, "normalized": True, "count": 4,
                                "type": "VEC3", "min": [-16384, 0, -32767], "max": [32767, 20000, 5]})
    flat = f.positions([(float(x), 0.0, float(z)) for x in range(3) for z in range(2)])
    f.json["accessors"][flat]["sparse"] = {
        "count": 2, "indices": {"bufferView": f.view(struct.pack("<2B", 1, 4)), "componentType": 5121},
        "values": {"bufferView": f.view(struct.pack("<6f", 0, 2, 1, 2, -1, 0.5))}}
    grid = [(x, 0.0, z) for x in range(3) for z in range(2)]
    grid[1], grid[4] = (0, 2, 1), (2, -1, 0.5)
    faces = [(0, 1, 2), (2, 1, 3), (2, 3, 4), (4, 3, 5)]
    f.json |= {"scene": 0, "scenes": [{"nodes": [0, 1]}], "extensionsUsed": ["KHR_mesh_quantization"], "extensionsRequired": ["KHR_mesh_quantization"],
               "nodes": [{"name": "small", "mesh": 0, "scale": [10, 10, 10]}, {"name": "sheet", "mesh": 1}],
               "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": f.indices([i for t in tent for i in t], 5125)}]},
                          {"primitives": [{"attributes": {"POSITION": flat}, "indices": f.indices([i for t in faces for i in t], 5121)}]}]}
    f.write_gltf("packed.gltf", "packed.bin")
    expect("packed", [{"name": "small", "triangles": triangles([[max(c / 32767, -1) for c in p] for p in short], tent, {"scale": [10, 10, 10]})},
                      {"name": "sheet", "triangles": triangles(grid, faces)}])


def instances():
    """EXT_mesh_gpu_instancing below a parent, and one mesh in two nodes at the same place."""
    f = File()
    at = [(5.0, 0.0, 0.0), (0.0, 5.0, 1.0), (-5.0, 0.0, 2.0)]
    turns = [turned((0, 0, 1), 0), turned((0, 1, 0), 120), turned((1, 0, 1), 200)]
    sizes = [(1.0, 1.0, 1.0), (2.0, 1.0, 0.5), (0.5, 0.5, 0.5)]
    parent = {"rotation": turned((0, 1, 1), 30), "children": [1]}
    mesh = {"primitives": [{"attributes": {"POSITION": f.positions(TENT)}, "indices": f.indices([i for t in TENT_FACES for i in t])}]}
    many = {"name": "many", "mesh": 0, "translation": [0, 0, 1],
            "extensions": {"EXT_mesh_gpu_instancing": {"attributes": {"TRANSLATION": f.accessor(at, 5126), "ROTATION": f.accessor(turns, 5126),
                                                                      "SCALE": f.accessor(sizes, 5126)}}}}
    twin = {"name": "twin", "mesh": 0, "translation": [0, 0, -9]}
    f.json |= {"scene": 0, "scenes": [{"nodes": [0, 2, 3]}], "meshes": [mesh], "nodes": [parent, many, twin, twin],
               "extensionsUsed": ["EXT_mesh_gpu_instancing"]}
    f.write_glb("instances.glb")
    each = [{"translation": t, "rotation": q, "scale": s} for t, q, s in zip(exact(at), exact(turns), exact(sizes))]
    expect("instances", [{"name": "many", "triangles": triangles(TENT, TENT_FACES, one, many, parent)} for one in each] +
           2 * [{"name": "twin", "triangles": triangles(TENT, TENT_FACES, twin)}])


CASES = (nodes, strips, packed, instances)
