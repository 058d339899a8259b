"""Where nodes stand: trees, matrices, mirrors, scenes, instances from packed arrays."""

from document import TENT, TENT_FACES, File, expect, triangles, turned, world


def tent_at(name, *chain, faces=TENT_FACES):
    return {"name": name, "triangles": triangles(TENT, faces, *chain)}


def deep():
    """Six levels whose scales and rotations shear what is below; one mesh in three of them."""
    f = File()
    chain = [{"name": f"level{k}", "translation": [0.5 * k, 1.0 - k, 0.25], "rotation": turned((1, k, 2 - k), 25 + 10 * k),
              "scale": [1.0 + 0.25 * k, 1.5 - 0.2 * k, 0.75]} for k in range(6)]
    nodes = [dict(node, children=[k + 1]) if k < 5 else dict(node) for k, node in enumerate(chain)]
    for k in (1, 3, 5):
        nodes[k]["mesh"] = 0
    f.scene(nodes, [0], [f.tent()])
    f.write_gltf("deep.gltf")
    expect("deep", [tent_at(f"level{k}", *reversed(chain[:k + 1])) for k in (1, 3, 5)])


def mirrored():
    """One, two and three negative scales, and a mirror below a mirror."""
    f = File()
    one = {"name": "one", "mesh": 0, "scale": [-1, 1, 1]}
    two = {"name": "two", "mesh": 0, "scale": [-2, -1, 1], "translation": [5, 0, 0]}
    three = {"name": "three", "mesh": 0, "scale": [-1, -1, -0.5], "translation": [0, 5, 0], "rotation": turned((1, 1, 0), 50)}
    parent = {"name": "parent", "scale": [1, -1, 1], "translation": [0, 0, 9]}
    twice = {"name": "twice", "mesh": 0, "scale": [1, 1, -3], "rotation": turned((0, 0, 1), 30)}
    f.scene([one, two, three, parent | {"children": [4]}, twice], [0, 1, 2, 3], [f.tent()])
    f.write_glb("mirrored.glb")
    expect("mirrored", [tent_at("one", one), tent_at("two", two), tent_at("three", three), tent_at("twice", twice, parent)])


def matrix_of(node):
    """Of nodes by translation, rotation and scale: only such matrices are allowed."""
    o = world((0, 0, 0), node)
    columns = [[a - b for a, b in zip(world(p, node), o)] for p in ((1, 0, 0), (0, 1, 0), (0, 0, 1))]
    return [*columns[0], 0, *columns[1], 0, *columns[2], 0, *o, 1]


def matrices():
    """Matrices, one below the other: together they shear. The second one mirrors."""
    f = File()
    above = {"name": "above", "matrix": matrix_of({"translation": (4, 5, 6), "rotation": turned((1, 2, -1), 70), "scale": (3, 1, 0.5)})}
    below = {"name": "below", "matrix": matrix_of({"translation": (-1, 0.5, 0), "rotation": turned((0, 1, 1), 140), "scale": (1, -2, 0.75)})}
    f.scene([above | {"mesh": 0, "children": [1]}, below | {"mesh": 0}], [0], [f.tent()])
    f.write_gltf("matrices.gltf")
    expect("matrices", [tent_at("above", above), tent_at("below", below, above)])


def scenes():
    """Three scenes, of which the file names the second; nodes of the others, and of none, are left out."""
    f = File()
    nodes = [{"name": name, "mesh": 0, "translation": [4 * k, 0, k]} for k, name in enumerate(["first", "second", "third", "fourth", "loose"])]
    f.scene(nodes, [0], [f.tent()])
    f.json |= {"scene": 1, "scenes": [{"nodes": [0]}, {"name": "shown", "nodes": [1, 2]}, {"nodes": [3]}]}
    f.write_gltf("scenes.gltf")
    expect("scenes", [tent_at("second", nodes[1]), tent_at("third", nodes[2])], ignored=["other scenes"])


def packed_instances():
    """EXT_mesh_gpu_instancing by places alone, and by rotations of 16 bits that are normalized."""
    f = File()
    at = [(0.0, 0.0, 0.0), (3.0, 1.0, -2.0), (-4.0, 0.5, 6.0), (0.0, -7.0, 1.0)]
    turns = [[round(c * 32767) for c in turned((k, 1, 2), 40 * k)] for k in range(3)]
    rotations = f.accessor(turns, 5122, normalized=True)
    places = {"name": "places", "mesh": 0, "scale": [2, 2, 2],
              "extensions": {"EXT_mesh_gpu_instancing": {"attributes": {"TRANSLATION": f.accessor(at, 5126)}}}}
    spun = {"name": "spun", "mesh": 0, "translation": [20, 0, 0],
            "extensions": {"EXT_mesh_gpu_instancing": {"attributes": {"TRANSLATION": f.accessor(at[:3], 5126), "ROTATION": rotations}}}}
    f.scene([places, spun], [0, 1], [f.tent()], extensionsUsed=["EXT_mesh_gpu_instancing"], extensionsRequired=["EXT_mesh_gpu_instancing"])
    f.write_gltf("packed_instances.gltf")
    exactly = []
    for turn in turns:
        q = [c / 32767 for c in turn]
        length = sum(c * c for c in q) ** 0.5
        exactly.append([c / length for c in q])
    expect("packed_instances", [tent_at("places", {"translation": t}, places) for t in at] +
           [tent_at("spun", {"translation": t, "rotation": q}, spun) for t, q in zip(at, exactly)])


CASES = (deep, mirrored, matrices, scenes, packed_instances)
