# SPDX-License-Identifier: Apache-2.0
"""Renders a scene by Blender's Cycles, on the processor:
blender -b --factory-startup --python-exit-code 1 -P render_reference.py -- SCENE.json OUT.exr [--spp N] [--seed N]

All objects are meshes with their vertices' normals. The EXR is linear: R, G, B, without a view transform.
"""

import argparse
import json
import pathlib
import sys

import bpy
import numpy as np
from mathutils import Matrix, Vector

sys.dont_write_bytecode = True  # Blender does not read the environment variable
sys.path.append(str(pathlib.Path(__file__).resolve().parent))
import meshes

LAMP_LEVELS = 5  # 20480 facets, which lack 0.03% of a sphere's area


def principled(nodes, material):
    """GGX with alpha = roughness^2, light scattered many times included (a random walk over the facets, Heitz 2016),
    reflecting color head on and all of it at grazing angles."""
    node = nodes.new("ShaderNodeBsdfPrincipled")
    node.distribution = "MULTI_GGX"
    node.inputs["Metallic"].default_value = 1
    node.inputs["Base Color"].default_value = (*material["color"], 1)
    node.inputs["Roughness"].default_value = material["roughness"]
    return node


def simple(nodes, kind, material):
    names = {"matte": "ShaderNodeBsdfDiffuse", "mirror": "ShaderNodeBsdfGlossy", "glass": "ShaderNodeBsdfGlass"}
    node = nodes.new(names[kind])
    node.inputs["Color"].default_value = (*material["color"], 1)
    node.inputs["Roughness"].default_value = 0
    if kind != "matte" and bpy.app.version < (4, 0):  # later versions do this if roughness is 0
        node.distribution = "SHARP"
    if kind == "glass":
        node.inputs["IOR"].default_value = material["index"]
    return node


def newMaterial(name, make):
    """A material whose surface is the node that make(nodes) returns."""
    material = bpy.data.materials.new(name)
    material.use_nodes = True
    nodes = material.node_tree.nodes
    nodes.clear()
    output = nodes.new("ShaderNodeOutputMaterial")
    material.node_tree.links.new(make(nodes).outputs[0], output.inputs["Surface"])
    return material


def surface(name, material):
    kind = material["kind"]
    if kind == "metal":
        return newMaterial(name, lambda nodes: principled(nodes, material))
    return newMaterial(name, lambda nodes: simple(nodes, kind, material))


def emitter(name, radiance):
    def make(nodes):
        node = nodes.new("ShaderNodeEmission")
        node.inputs["Color"].default_value = (*radiance, 1)
        return node

    return newMaterial(name, make)


def addMesh(name, positions, normals, faces, material):
    """Triangles; normals None leaves them flat."""
    mesh = bpy.data.meshes.new(name)
    mesh.vertices.add(len(positions))
    mesh.vertices.foreach_set("co", np.ascontiguousarray(positions, np.float32).ravel())
    mesh.loops.add(3 * len(faces))
    mesh.loops.foreach_set("vertex_index", np.ascontiguousarray(faces, np.int32).ravel())
    mesh.polygons.add(len(faces))
    mesh.polygons.foreach_set("loop_start", np.arange(0, 3 * len(faces), 3, dtype=np.int32))
    mesh.polygons.foreach_set("loop_total", np.full(len(faces), 3, np.int32))
    mesh.polygons.foreach_set("use_smooth", np.full(len(faces), normals is not None))
    mesh.update(calc_edges=True)
    if normals is not None:
        if bpy.app.version < (4, 1):  # later versions always use a mesh's own normals
            mesh.use_auto_smooth = True
        mesh.normals_split_custom_set_from_vertices(np.asarray(normals, np.float32).tolist())
    mesh.materials.append(material)
    thing = bpy.data.objects.new(name, mesh)
    bpy.context.scene.collection.objects.link(thing)
    return thing


def addQuad(name, quad, material):
    center, u, v = (np.array(quad[key], float) for key in ("center", "u", "v"))
    corners = np.array([center - u - v, center + u - v, center + u + v, center - u + v])
    addMesh(name, corners, None, np.array([[0, 1, 2], [0, 2, 3]]), material)


def addBox(name, box, material):
    low, high = np.array(box["min"], float), np.array(box["max"], float)
    center, half = (low + high) / 2, np.diag((high - low) / 2)
    for axis in range(3):
        for side in (-1, 1):
            sides = {"center": center + side * half[axis], "u": half[axis - 2], "v": half[axis - 1]}
            addQuad(f"{name}-{axis}{side}", sides, material)


def addPoint(name, light):
    lamp = bpy.data.lights.new(name, "POINT")
    lamp.shadow_soft_size = 0
    # Watts over all directions.
    lamp.energy, lamp.color = 4 * np.pi * max(light["intensity"]), np.array(light["intensity"]) / max(light["intensity"])
    thing = bpy.data.objects.new(name, lamp)
    thing.location = light["position"]
    bpy.context.scene.collection.objects.link(thing)


def addLamp(name, light):
    if light["type"] == "point":
        addPoint(name, light)
        return
    material = emitter(name, light["radiance"])
    if light["type"] == "quad":
        addQuad(name, light, material)
        return
    positions, normals, faces = meshes.sphere(LAMP_LEVELS)
    addMesh(name, positions * light["radius"] + np.array(light["center"]), normals, faces, material)


def addCamera(scene):
    camera = bpy.data.cameras.new("camera")
    camera.sensor_fit = "VERTICAL"
    camera.angle_y = np.radians(scene["camera"]["fov"])
    camera.clip_start, camera.clip_end = 1e-3, 1e3
    eye, target, up = (Vector(scene["camera"][key]) for key in ("eye", "target", "up"))
    back = (eye - target).normalized()
    right = up.cross(back).normalized()
    thing = bpy.data.objects.new("camera", camera)
    thing.matrix_world = Matrix.Translation(eye) @ Matrix((right, back.cross(right), back)).transposed().to_4x4()
    bpy.context.scene.collection.objects.link(thing)
    bpy.context.scene.camera = thing


def addSky(color):
    world = bpy.data.worlds.new("sky")
    world.use_nodes = True
    background = world.node_tree.nodes["Background"]
    background.inputs["Color"].default_value = (*color, 1)
    background.inputs["Strength"].default_value = 1
    bpy.context.scene.world = world


def build(scene, folder):
    for thing in list(bpy.data.objects):
        bpy.data.objects.remove(thing)
    materials = {name: surface(name, material) for name, material in scene["materials"].items()}
    for i, item in enumerate(scene["instances"]):
        mesh = meshes.readPly(folder / (item["mesh"] + ".ply"))
        thing = addMesh(f"instance-{i}", *mesh, materials[item["material"]])
        thing.matrix_world = Matrix.Translation(item["translate"]) @ Matrix.Scale(item["scale"], 4)
    for i, shape in enumerate(scene["shapes"]):
        add = addBox if shape["type"] == "box" else addQuad
        add(f"shape-{i}", shape, materials[shape["material"]])
    for i, light in enumerate(scene["lights"]):
        addLamp(f"lamp-{i}", light)
    addSky(scene["sky"])
    addCamera(scene)


def plainPathTracing(scene, spp, seed):
    """No settings that trade accuracy for less noise: no clamping, no glossy filtering, no thresholds, no denoiser."""
    settings = bpy.context.scene
    settings.render.engine = "CYCLES"
    cycles = settings.cycles
    cycles.device, cycles.samples, cycles.seed = "CPU", spp, seed
    cycles.use_adaptive_sampling = cycles.use_denoising = False
    for kind in ("max", "diffuse", "glossy", "transmission"):
        setattr(cycles, kind + "_bounces", scene["bounces"])
    cycles.transparent_max_bounces = scene["bounces"]
    cycles.sample_clamp_direct = cycles.sample_clamp_indirect = 0
    cycles.blur_glossy = cycles.light_sampling_threshold = 0
    cycles.caustics_reflective = cycles.caustics_refractive = True
    cycles.pixel_filter_type = "BOX"
    settings.render.resolution_x = settings.render.resolution_y = scene["size"]
    settings.render.resolution_percentage = 100


def linearExr(path):
    settings = bpy.context.scene
    settings.view_settings.view_transform = "Raw"
    settings.view_settings.look = "None"
    settings.view_settings.exposure, settings.view_settings.gamma = 0, 1
    image = settings.render.image_settings
    image.file_format, image.color_mode, image.color_depth, image.exr_codec = "OPEN_EXR", "RGB", "32", "ZIP"
    settings.render.filepath = str(path)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("scene", type=pathlib.Path)
    parser.add_argument("output", type=pathlib.Path)
    parser.add_argument("--spp", type=int, default=1024)
    parser.add_argument("--seed", type=int, default=0)
    options = parser.parse_args(sys.argv[sys.argv.index("--") + 1:])
    scene = json.loads(options.scene.read_text())
    build(scene, options.scene.resolve().parent)
    plainPathTracing(scene, options.spp, options.seed)
    linearExr(options.output.resolve())
    bpy.ops.render.render(write_still=True)


if __name__ == "__main__":
    main()
