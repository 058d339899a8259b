"""Colors, normals, cameras, lights; what has no place in a scene."""
import base64
import math
import struct
import zlib

from document import TENT, TENT_FACES, File, expect, mirrored, triangles, turned, world


def colors():
    """Three primitives of one mesh: two materials and none. A color beyond 1 counts as 1."""
    f = File()
    pieces = [TENT, [(x + 3, y, z) for x, y, z in TENT], [(x + 6, y, z) for x, y, z in TENT]]
    corners = f.indices([i for t in TENT_FACES for i in t])
    f.scene([{"name": "three", "mesh": 0}], [0], [{"primitives": [
        {"attributes": {"POSITION": f.positions(p)}, "indices": corners, **({"material": k} if k < 2 else {})} for k, p in enumerate(pieces)]}],
        materials=[{"pbrMetallicRoughness": {"baseColorFactor": [0.25, 0.5, 0.125, 1]}}, {"name": "white"}])
    f.write_gltf("colors.gltf")
    expect("colors", [{"name": "three", "triangles": sum((triangles(p, TENT_FACES) for p in pieces), []),
                       "colors": 4 * [[0.25, 0.5, 0.125]] + 4 * [[1, 1, 1]] + 4 * [None]}])


def turned_normal(n, *chain):
    """Across the images of two vectors that are across n; on the mirrored side where the chain mirrors."""
    a = (n[1], -n[0], 0) if abs(n[2]) < 0.9 else (0, n[2], -n[1])
    b = [n[(k + 1) % 3] * a[(k + 2) % 3] - n[(k + 2) % 3] * a[(k + 1) % 3] for k in range(3)]
    o = world((0, 0, 0), *chain)
    a, b = ([s - t for s, t in zip(world(v, *chain), o)] for v in (a, b))
    out = [a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3] for k in range(3)]
    length = math.sqrt(sum(c * c for c in out)) * (-1 if mirrored(*chain) else 1)
    return [c / length for c in out]


def normals():
    """Vertex normals below scales that are not uniform, of 8 bits in the second mesh; and a node that mirrors."""
    f = File()
    given = [(0.0, 1.0, 0.0), (0.6, 0.8, 0.0), (0.0, 0.6, 0.8), (-0.6, 0.0, 0.8)]
    small = [tuple(round(127 * c) for c in n) for n in given]
    packed = f.view(b"".join(struct.pack("<3bx", *n) for n in small), byteStride=4, target=34962)
    f.json["accessors"].append({"bufferView": packed, "componentType": 5120, "normalized": True, "count": 4, "type": "VEC3"})
    meshes = [f.tent(), f.tent()]
    meshes[0]["primitives"][0]["attributes"]["NORMAL"] = f.accessor(given, 5126)
    meshes[1]["primitives"][0]["attributes"]["NORMAL"] = 0
    nodes = [{"name": "long", "mesh": 0, "scale": [4, 1, 0.5], "rotation": turned((1, 2, 0), 35)},
             {"name": "turned", "mesh": 0, "scale": [-1, 2, 1], "translation": [9, 0, 0]},
             {"name": "packed", "mesh": 1, "scale": [1, 3, 1], "translation": [0, 0, 9]}]
    f.scene(nodes, [0, 1, 2], meshes, extensionsUsed=["KHR_mesh_quantization"], extensionsRequired=["KHR_mesh_quantization"])
    f.write_gltf("normals.gltf")
    objects = []
    for node in nodes:
        of = given if node["mesh"] == 0 else small
        flip = mirrored(node)
        objects.append({"name": node["name"], "triangles": triangles(TENT, TENT_FACES, node),
                        "normals": [[turned_normal(of[i], node) for i in ((a, c, b) if flip else (a, b, c))] for a, b, c in TENT_FACES]})
    expect("normals", objects)


def cameras():
    """The first camera has no perspective; the one that counts stands below two nodes; a third is left out."""
    f = File()
    orthographic = {"camera": 0, "translation": [0, 0, 50]}
    arm, head = {"translation": [0, 6, 0], "rotation": turned((0, 1, 0), 60)}, {"translation": [0, 0, 8], "rotation": turned((1, 0, 0), -30)}
    f.scene([{"name": "tent", "mesh": 0}, orthographic, arm | {"children": [3]}, head | {"camera": 1}, {"camera": 2, "translation": [1, 1, 1]}], [0, 1, 2, 4], [f.tent()],
            cameras=[{"type": "orthographic", "orthographic": {"xmag": 2, "ymag": 2, "znear": 0.1, "zfar": 100}},
                     {"type": "perspective", "perspective": {"yfov": math.radians(50), "aspectRatio": 1.5, "znear": 0.1, "zfar": 100}},
                     {"type": "perspective", "perspective": {"yfov": 1, "znear": 0.1}}])
    f.write_gltf("cameras.gltf")
    eye, front = world((0, 0, 0), head, arm), world((0, 0, -1), head, arm)
    expect("cameras", [{"name": "tent", "triangles": triangles(TENT, TENT_FACES)}],
           camera={"eye": eye, "towards": [a - b for a, b in zip(front, eye)], "fov_y_degrees": 50}, ignored=["orthographic cameras", "other cameras"])


def lights():
    """Each kind below a node that turns and scales it; sizes in the extras of the light or of its node; area lights, whose size grows with their largest scale."""
    f = File()
    arm = {"translation": [1, 2, 3], "rotation": turned((1, 0, 0), -60), "scale": [2, 2, 2]}
    named = lambda k: {"extensions": {"KHR_lights_punctual": {"light": k}}}
    places = [{"rotation": turned((0, 1, 0), 20)}, {"translation": [0, 0, 4]}, {"translation": [1, 0, 0], "rotation": turned((0, 1, 0), -45)},
              {"translation": [0, 3, 1], "rotation": turned((1, 2, 0), 35), "scale": [0.5, 3, 1]}, {"translation": [2, 3, 0], "rotation": turned((0, 1, 1), 70)}]
    area = lambda k: {"extensions": {"EXT_lights_area": {"light": k}}}
    f.scene([{"name": "tent", "mesh": 0}, arm | {"children": [2, 3, 4, 5, 6]}, places[0] | named(0) | {"extras": {"angle_degrees": 1.25}}, places[1] | named(1),
             places[2] | named(2) | {"extras": {"radius": 0.75}}, places[3] | area(1) | {"name": "panel"}, places[4] | area(0)], [0, 1], [f.tent()],
            extensionsUsed=["KHR_lights_punctual", "EXT_lights_area"],
            extensions={"EXT_lights_area": {"lights": [{"type": "disk", "name": "lamp", "size": 0.5, "color": [1, 0.5, 0.25], "intensity": 20},
                                                       {"type": "rect", "size": 0.25, "rect": {"aspect": 4}}]},
                        "KHR_lights_punctual": {"lights": [
                {"type": "directional", "name": "sun", "color": [1, 0.9, 0.5], "intensity": 2},
                {"type": "point", "name": "bulb", "intensity": 7, "extras": {"radius": 0.25}},
                {"type": "spot", "name": "spot", "color": [0.5, 1, 0.25], "intensity": 4, "spot": {"innerConeAngle": 0.2, "outerConeAngle": 0.5}}]}})
    f.write_glb("lights.glb")
    at = lambda p, k: world(p, places[k], arm)
    way = lambda k: [(b - a) / 2 for a, b in zip(at((0, 0, 0), k), at((0, 0, -1), k))]
    expect("lights", [{"name": "tent", "triangles": triangles(TENT, TENT_FACES)}],
           lights=[{"name": "sun", "direction": way(0), "angle_degrees": 1.25, "irradiance": [2, 1.8, 1]},
                   {"name": "bulb", "center": at((0, 0, 0), 1), "radius": 0.25, "radiance": [7 / (math.pi / 16)] * 3},
                   {"name": "spot", "center": at((0, 0, 0), 2), "normal": way(2), "radius": 0.75, "radiance": [c / (math.pi * 0.5625) for c in (2, 4, 1)]},
                   {"name": "panel", "extension": "EXT_lights_area", "center": at((0, 0, 0), 3), "normal": way(3), "tangent": [b - a for a, b in zip(at((0, 0, 0), 3), at((1, 0, 0), 3))],
                    "half_extents": [3.0, 0.75], "radiance": [1000] * 3},
                   {"name": "lamp", "extension": "EXT_lights_area", "center": at((0, 0, 0), 4), "normal": way(4), "radius": 0.5, "radiance": [20, 10, 5]}],
           ignored=["cones of spot lights"])


def png():
    chunk = lambda kind, data: struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">2I5B", 1, 1, 8, 2, 0, 0, 0)) + chunk(b"IDAT", zlib.compress(b"\0\xff\0\0")) +
            chunk(b"IEND", b""))


def ignored():
    """Morph targets, a skin, an animation, vertex colors, a texture in the file, transparency: the mesh stands where its node says."""
    f = File()
    mesh = f.tent(targets=[{"POSITION": f.positions([(0.0, 5.0, 0.0)] * 4)}], material=0)
    joints, weights = f.accessor([(0, 0, 0, 0)] * 4, 5121), f.accessor([(1.0, 0.0, 0.0, 0.0)] * 4, 5126)
    mesh["primitives"][0]["attributes"] |= {"COLOR_0": f.accessor([(1.0, 0.0, 0.0)] * 4, 5126), "JOINTS_0": joints, "WEIGHTS_0": weights}
    mesh["weights"] = [0]
    times, places = f.accessor([(0.0,), (1.0,)], 5126, min=[0], max=[1]), f.accessor([(0.0, 0.0, 0.0), (0.0, 9.0, 0.0)], 5126)
    body = {"name": "body", "mesh": 0, "translation": [1, 2, 3]}
    f.scene([body | {"skin": 0}, {"name": "joint"}], [0, 1], [mesh], skins=[{"joints": [1]}],
            animations=[{"channels": [{"sampler": 0, "target": {"node": 0, "path": "translation"}}], "samplers": [{"input": times, "output": places}]}],
            materials=[{"alphaMode": "BLEND", "emissiveFactor": [1, 1, 1], "pbrMetallicRoughness": {"baseColorFactor": [0.5, 0.5, 0.5, 0.5], "baseColorTexture": {"index": 0}}}],
            textures=[{"source": 0}], images=[{"uri": "data:image/png;base64," + base64.b64encode(png()).decode()}])
    f.write_gltf("ignored.gltf")
    expect("ignored", [{"name": "body", "albedo": [0.5, 0.5, 0.5], "triangles": triangles(TENT, TENT_FACES, body)}],
           ignored=["morph targets", "skins", "animations", "vertex colors", "textures", "transparency", "emission"])


def lines():
    """Points, lines, a loop and a strip of lines beside triangles; a node with lines alone makes no object."""
    f = File()
    tent = f.tent()
    places = tent["primitives"][0]["attributes"]["POSITION"]
    kinds = [{"mode": mode, "attributes": {"POSITION": places}} for mode in (0, 1, 2, 3)]
    f.scene([{"name": "both", "mesh": 0}, {"name": "wires", "mesh": 1, "translation": [5, 0, 0]}], [0, 1],
            [{"primitives": kinds[:2] + tent["primitives"] + kinds[2:]}, {"primitives": kinds}])
    f.write_glb("lines.glb")
    expect("lines", [{"name": "both", "triangles": triangles(TENT, TENT_FACES)}], ignored=["points and lines"])


def compressed():
    """What is refused by name; the data are missing."""
    for name, extension, of in (("draco", "KHR_draco_mesh_compression", "Draco"), ("meshopt", "EXT_meshopt_compression", "meshopt")):
        f = File()
        f.scene([{"mesh": 0}], [0], [f.tent()], extensionsUsed=[extension], extensionsRequired=[extension])
        f.write_gltf(f"{name}.gltf")
        expect(name, [], refused=of)


CASES = (colors, normals, cameras, lights, ignored, lines, compressed)
