"""Renders one scene with Cycles, inside Blender: blender -b --python blender_render.py -- JOB.json.

scripts/blender-compare.py writes the job. One unit is a millimetre, and the axes are Nacre's: +Y is up.
"""
import array
import json
import math
import sys

import bpy
import mathutils


def read_array(path, kind):
    values = array.array(kind)
    with open(path, "rb") as file:
        values.frombytes(file.read())
    return values


def triples(values):
    return list(zip(values[0::3], values[1::3], values[2::3]))


def add_mesh(job):
    mesh = bpy.data.meshes.new(job["name"])
    mesh.from_pydata(triples(read_array(job["positions"], "f")), [], triples(read_array(job["triangles"], "i")))
    mesh.polygons.foreach_set("use_smooth", [True] * len(mesh.polygons))
    mesh.use_auto_smooth = True  # without it, custom normals are not used
    mesh.normals_split_custom_set_from_vertices(triples(read_array(job["normals"], "f")))
    mesh.update()
    body = bpy.data.objects.new(job["name"], mesh)
    bpy.context.collection.objects.link(body)
    body.data.materials.append(make_material(job["material"]))


def make_material(job):
    material = bpy.data.materials.new("material")
    material.use_nodes = True
    nodes = material.node_tree.nodes
    nodes.clear()
    color = tuple(job["albedo"]) + (1,)
    if job["method"] == "DIFFUSE":
        shader = nodes.new("ShaderNodeBsdfDiffuse")
        shader.inputs["Color"].default_value = color
    else:
        shader = nodes.new("ShaderNodeSubsurfaceScattering")
        shader.falloff = job["method"]
        shader.inputs["Color"].default_value = color
        shader.inputs["Scale"].default_value = 1
        shader.inputs["Radius"].default_value = job["radius"]
        if "Anisotropy" in shader.inputs:
            shader.inputs["Anisotropy"].default_value = 0
    output = nodes.new("ShaderNodeOutputMaterial")
    material.node_tree.links.new(shader.outputs["BSSRDF" if "BSSRDF" in shader.outputs else 0], output.inputs["Surface"])
    return material


def looking(position, target, up):
    """The matrix of something that looks along its own -Z."""
    back = (mathutils.Vector(position) - mathutils.Vector(target)).normalized()
    right = mathutils.Vector(up).cross(back).normalized()
    matrix = mathutils.Matrix((right, back.cross(right), back)).transposed().to_4x4()
    matrix.translation = position
    return matrix


def add_camera(job):
    camera = bpy.data.cameras.new("camera")
    camera.sensor_fit = "VERTICAL"
    camera.clip_start, camera.clip_end = 0.1, 1e5
    if "orthographicHeight" in job:
        camera.type = "ORTHO"
        camera.ortho_scale = job["orthographicHeight"]
    else:
        camera.angle = math.radians(job["verticalFieldOfView"])
    place = bpy.data.objects.new("camera", camera)
    place.matrix_world = looking(job["position"], job["target"], job["up"])
    bpy.context.collection.objects.link(place)
    bpy.context.scene.camera = place


def add_sun(direction):
    sun = bpy.data.lights.new("sun", "SUN")
    sun.energy = 1  # the irradiance on what faces it
    sun.angle = 0
    place = bpy.data.objects.new("sun", sun)
    up = (0, 1, 0) if abs(direction[1]) < 0.9 else (0, 0, 1)
    place.matrix_world = looking((0, 0, 0), direction, up)
    bpy.context.collection.objects.link(place)


def set_up(job):
    scene = bpy.context.scene
    scene.render.engine = "CYCLES"
    cycles = scene.cycles
    cycles.device = "CPU"
    cycles.samples = job["samples"]
    cycles.seed = job["seed"]
    cycles.use_adaptive_sampling = False
    cycles.use_denoising = False
    cycles.max_bounces = 0  # direct light alone; the ways under a surface are no bounces
    cycles.sample_clamp_direct = cycles.sample_clamp_indirect = 0
    cycles.pixel_filter_type = "GAUSSIAN"  # a box is always a pixel wide
    cycles.filter_width = 0.01  # a pixel's middle
    scene.render.resolution_x, scene.render.resolution_y = job["size"]
    scene.render.resolution_percentage = 100
    scene.render.film_transparent = True
    if job["threads"]:
        scene.render.threads_mode = "FIXED"
        scene.render.threads = job["threads"]
    scene.render.image_settings.file_format = "OPEN_EXR"
    scene.render.image_settings.color_depth = "32"
    scene.render.image_settings.exr_codec = "ZIP"
    scene.render.filepath = job["output"]
    world = bpy.data.worlds.new("dark")
    world.use_nodes = True
    world.node_tree.nodes["Background"].inputs["Color"].default_value = (0, 0, 0, 1)
    scene.world = world


def main():
    with open(sys.argv[sys.argv.index("--") + 1]) as file:
        job = json.load(file)
    bpy.ops.wm.read_factory_settings(use_empty=True)
    set_up(job)
    for mesh in job["meshes"]:
        add_mesh(mesh)
    add_camera(job["camera"])
    add_sun(job["light"])
    bpy.ops.render.render(write_still=True)


main()
