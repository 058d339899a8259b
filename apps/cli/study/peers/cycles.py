# Run by Blender: penumbra study --peers. Renders one scene by Cycles, with and without shadows.
#
# usage: blender --background --factory-startup --python cycles.py -- SCENE.json FOLDER THREADS ROUNDS SETTING...
#
# A setting is SAMPLES-WEIGHTS: 64-irradiance is Blender's light on a diffuse surface, 64-even adds every point of the light
# alike. Writes FOLDER/shadowed-SETTING.exr and FOLDER/lit-SETTING.exr, and last FOLDER/times.json: milliseconds of frames with
# shadows, at most ROUNDS of each setting.
import base64
import json
import math
import pathlib
import sys
import time

import bpy
import numpy
from mathutils import Matrix

MOST_MS = 10_000


def matrix_of(x, y, z, origin):
    return Matrix([[x[k], y[k], z[k], origin[k]] for k in range(3)] + [[0, 0, 0, 1]])


def negative(v):
    return [-c for c in v]


def white(weights):
    """Diffuse; or without the cosine, which a toon shader of the whole half-space has not."""
    material = bpy.data.materials.new(weights)
    material.use_nodes = True
    nodes = material.node_tree.nodes
    nodes.clear()
    surface = nodes.new("ShaderNodeBsdfDiffuse" if weights == "irradiance" else "ShaderNodeBsdfToon")
    surface.inputs["Color"].default_value = (1, 1, 1, 1)
    if weights == "even":
        surface.component = "DIFFUSE"
        surface.inputs["Size"].default_value, surface.inputs["Smooth"].default_value = 1, 0
    output = nodes.new("ShaderNodeOutputMaterial")
    material.node_tree.links.new(surface.outputs[0], output.inputs["Surface"])
    return material


def add_object(scene, given, material):
    positions = numpy.frombuffer(base64.b64decode(given["positions"]), "<f4")
    corners = numpy.frombuffer(base64.b64decode(given["triangles"]), "<u4").astype(numpy.int32)
    faces = len(corners) // 3
    mesh = bpy.data.meshes.new("mesh")
    mesh.vertices.add(len(positions) // 3)
    mesh.vertices.foreach_set("co", positions)
    mesh.loops.add(len(corners))
    mesh.loops.foreach_set("vertex_index", corners)
    mesh.polygons.add(faces)
    mesh.polygons.foreach_set("loop_start", numpy.arange(0, 3 * faces, 3, numpy.int32))
    mesh.polygons.foreach_set("loop_total", numpy.full(faces, 3, numpy.int32))
    mesh.update(calc_edges=True)
    mesh.materials.append(material)
    made = bpy.data.objects.new("object", mesh)
    scene.collection.objects.link(made)
    return made


def add_camera(scene, given):
    camera = bpy.data.cameras.new("camera")
    camera.sensor_fit = "VERTICAL"
    camera.angle = math.radians(given["fov_y_degrees"])
    camera.clip_start, camera.clip_end = given["near"], given["far"]
    made = bpy.data.objects.new("camera", camera)
    made.matrix_world = matrix_of(given["right"], given["up"], negative(given["forward"]), given["eye"])
    scene.collection.objects.link(made)
    scene.camera = made


def weigh_evenly(light):
    """Emission times d² / cos at the light, so that equal areas add equally. Used where light.use_nodes is set."""
    light.use_nodes = True
    nodes, link = light.node_tree.nodes, light.node_tree.links.new
    emission = next(node for node in nodes if node.type == "EMISSION")
    geometry, falloff = nodes.new("ShaderNodeNewGeometry"), nodes.new("ShaderNodeLightFalloff")
    cosine, size, share = nodes.new("ShaderNodeVectorMath"), nodes.new("ShaderNodeMath"), nodes.new("ShaderNodeMath")
    cosine.operation, size.operation, share.operation = "DOT_PRODUCT", "ABSOLUTE", "DIVIDE"
    falloff.inputs["Strength"].default_value = 1
    link(geometry.outputs["Normal"], cosine.inputs[0])
    link(geometry.outputs["Incoming"], cosine.inputs[1])
    link(cosine.outputs["Value"], size.inputs[0])
    link(falloff.outputs["Constant"], share.inputs[0])
    link(size.outputs[0], share.inputs[1])
    link(share.outputs[0], emission.inputs["Strength"])


def add_light(scene, given):
    distant = given["kind"] == "distant"
    light = bpy.data.lights.new("light", "SUN" if distant else "AREA")
    if distant:
        light.angle = math.radians(given["angle_degrees"])
        light.energy = 3
    else:
        light.shape, light.size = "DISK", 2 * given["radius"]
        light.energy = 100 * given["distance"] ** 2
        light.spread = math.pi
        weigh_evenly(light)
    light.cycles.max_bounces = 0
    light.cycles.use_multiple_importance_sampling = False
    made = bpy.data.objects.new("light", light)
    made.matrix_world = matrix_of(given["u"], given["v"], negative(given["normal"]), given["center"])
    made.visible_camera = False
    scene.collection.objects.link(made)
    return light


def set_up(scene, width, height, threads):
    render, cycles = scene.render, scene.cycles
    render.engine = "CYCLES"
    render.resolution_x, render.resolution_y, render.resolution_percentage = width, height, 100
    render.threads_mode, render.threads = "FIXED", threads
    render.use_persistent_data = True
    render.film_transparent = True
    render.image_settings.file_format = "OPEN_EXR"
    render.image_settings.color_mode = "RGB"
    render.image_settings.color_depth = "32"
    render.dither_intensity = 0
    cycles.device = "CPU"
    cycles.seed = 1
    cycles.use_adaptive_sampling = False
    cycles.use_denoising = False
    # Cycles' box is a whole pixel wide whatever its width says; this is a hundredth of a pixel.
    cycles.pixel_filter_type, cycles.filter_width = "BLACKMAN_HARRIS", .01
    cycles.max_bounces = 0
    cycles.sample_clamp_direct = cycles.sample_clamp_indirect = 0
    cycles.light_sampling_threshold = 0
    cycles.use_auto_tile = False
    scene.world = None


def render_ms():
    start = time.perf_counter()
    bpy.ops.render.render()
    return 1e3 * (time.perf_counter() - start)


def frames(first, rounds):
    """Milliseconds of as many frames as take some seconds; the first one where even two do not."""
    if 2 * first > MOST_MS:
        return [first]
    return [render_ms() for _ in range(max(1, min(rounds, int(MOST_MS / first) - 1)))]


def save(scene, path):
    bpy.data.images["Render Result"].save_render(str(path), scene=scene)


def main():
    given_path, folder, threads, rounds, *settings = sys.argv[sys.argv.index("--") + 1:]
    given, folder = json.loads(pathlib.Path(given_path).read_text()), pathlib.Path(folder)
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    set_up(scene, given["width"], given["height"], int(threads))
    materials = {weights: white(weights) for weights in ("irradiance", "even")}
    objects = [(add_object(scene, one, materials["even"]), one["casts"]) for one in given["objects"]]
    add_camera(scene, given["camera"])
    light = add_light(scene, given["light"])
    times = {}
    for shadows in False, True:
        for made, casts in objects:
            made.visible_shadow = shadows and casts
        for setting in settings:
            number, weights = setting.split("-")
            scene.cycles.samples = int(number) if shadows or weights != "even" else 1  # more tell no more
            scene.update_tag()  # else Blender renders with the number before
            light.use_nodes = weights == "even" and light.type == "AREA"
            for made, _ in objects:
                made.data.materials[0] = materials[weights]
            first = render_ms()  # which makes the hierarchy, where that is missing
            if shadows:
                times[setting] = frames(first, int(rounds))
            save(scene, folder / f"{'shadowed' if shadows else 'lit'}-{setting}.exr")
    (folder / "times.json").write_text(json.dumps({"version": bpy.app.version_string, "times": times}))


main()
