# SPDX-License-Identifier: Apache-2.0
"""Renders a scene by Mitsuba 3: render_mitsuba.py SCENE.json OUT.exr [--spp N] [--seed N] [--first-hits]

Spheres are analytic, everything else is a mesh. The EXR is linear: R, G, B. With --first-hits it has the first hits of
rays through pixel centres instead of light: Z (distance, infinite for a miss), N.X, N.Y, N.Z (towards the eye) and ID
(instances in their order, from 1; 0: anything else).

For a "caustic" scene, the picture is the light of all paths minus the light of paths that go straight from the floor to
the lamp. Both are traced with the same random numbers, so that the noise of their common light cancels.

Needs LLVM 17 or newer (Debian's libllvm19), found as DRJIT_LIBLLVM_PATH.
"""

import argparse
import json
import math
import pathlib

import mitsuba as mi
import numpy as np

mi.set_variant("llvm_ad_rgb")
T = mi.ScalarTransform4f

# Stratified over a pass of 8 x 8 samples; all samples of a picture at once would not fit in memory.
PASS_SPP = 64


def rgb(color):
    return {"type": "rgb", "value": list(color)}


def bsdf(material):
    color, kind = rgb(material["color"]), material["kind"]
    if kind == "matte":
        return {"type": "twosided", "bsdf": {"type": "diffuse", "reflectance": color}}
    if kind == "mirror":
        return {"type": "twosided", "bsdf": {"type": "conductor", "material": "none", "specular_reflectance": color}}
    if kind == "metal":  # GGX with alpha = roughness^2 and Schlick's Fresnel term, scattered once
        return {"type": "principled", "base_color": color, "metallic": 1.0, "roughness": material["roughness"]}
    if kind == "glass":
        return {"type": "dielectric", "int_ior": material["index"], "ext_ior": 1.0, "specular_transmittance": color}
    raise ValueError(f"material kind {kind}")


def quadFrame(quad):
    """Mitsuba's rectangle, [-1, 1] squared in z = 0 and facing +z, onto the quad."""
    center, u, v = (np.array(quad[key], float) for key in ("center", "u", "v"))
    normal = np.cross(u, v)
    frame = np.eye(4)
    frame[:3] = np.column_stack([u, v, normal / np.linalg.norm(normal), center])
    return T(frame)


def lamp(light):
    """Black except for its own emission."""
    if light["type"] == "point":
        return {"type": "point", "position": light["position"], "intensity": rgb(light["intensity"])}
    looks = {"emitter": {"type": "area", "radiance": rgb(light["radiance"])},
             "bsdf": {"type": "diffuse", "reflectance": rgb((0, 0, 0))}}
    if light["type"] == "sphere":
        return {"type": "sphere", "center": light["center"], "radius": light["radius"], **looks}
    return {"type": "rectangle", "to_world": quadFrame(light), **looks}


def instance(item, folder):
    looks = {"bsdf": {"type": "ref", "id": "material-" + item["material"]}}
    if item["mesh"] == "sphere":
        return {"type": "sphere", "center": item["translate"], "radius": item["scale"], **looks}
    place = T().translate(item["translate"]).scale(item["scale"])
    return {"type": "ply", "filename": str(folder / (item["mesh"] + ".ply")), "to_world": place, **looks}


def body(shape):
    looks = {"bsdf": {"type": "ref", "id": "material-" + shape["material"]}}
    if shape["type"] == "sphere":
        return {"type": "sphere", "center": shape["center"], "radius": shape["radius"], **looks}
    if shape["type"] == "box":
        low, high = np.array(shape["min"], float), np.array(shape["max"], float)
        place = T().translate(list((low + high) / 2)).scale(list((high - low) / 2))
        return {"type": "cube", "to_world": place, **looks}
    return {"type": "rectangle", "to_world": quadFrame(shape), **looks}


def sensor(scene):
    camera = scene["camera"]
    return {
        "type": "perspective", "fov_axis": "y", "fov": camera["fov"], "near_clip": 1e-3, "far_clip": 1e3,
        "to_world": T().look_at(origin=camera["eye"], target=camera["target"], up=camera["up"]),
        "film": {"type": "hdrfilm", "width": scene["size"], "height": scene["size"], "pixel_format": "rgb",
                 "component_format": "float32", "rfilter": {"type": "box"}},
        "sampler": {"type": "multijitter", "sample_count": PASS_SPP},
    }


def load(scene, folder):
    content = {"type": "scene", "sensor": sensor(scene)}
    content |= {f"material-{name}": bsdf(material) for name, material in scene["materials"].items()}
    content |= {f"instance-{i}": instance(item, folder) for i, item in enumerate(scene["instances"])}
    for i, shape in enumerate(scene["shapes"]):
        content[f"shape-{i}"] = body(shape)
    content |= {f"lamp-{i}": lamp(light) for i, light in enumerate(scene["lights"])}
    if any(scene["sky"]):
        content["sky"] = {"type": "constant", "radiance": rgb(scene["sky"])}
    return mi.load_dict(content, optimize=False)  # optimization would merge shapes and lose their names


def pathTracer(bounces):
    # Mitsuba counts the edges of paths, including the one from the eye.
    return mi.load_dict({"type": "path", "max_depth": bounces + 2, "rr_depth": 8})


def render(world, scene, seed):
    """PASS_SPP samples a pixel, (size, size, 3)."""
    def trace(bounces):
        return np.array(mi.render(world, integrator=pathTracer(bounces), spp=PASS_SPP, seed=seed), np.float64)
    return trace(scene["bounces"]) - (trace(0) if "caustic" in scene else 0)


def centreHits(world, size):
    """(size, size, 5), the channels of --first-hits."""
    row, column = np.divmod(np.arange(size * size), size)
    film = mi.Point2f((column + 0.5) / size, (row + 0.5) / size)
    rays, _ = world.sensors()[0].sample_ray(0.0, 0.5, film, mi.Point2f(0.5))
    hit = world.ray_intersect(rays)
    towards_eye = -np.array(rays.d).T
    eye = np.array(world.sensors()[0].world_transform().matrix)[:3, 3].ravel()
    distance = np.linalg.norm(np.array(hit.p).T - eye, axis=1)
    normal = np.array(hit.sh_frame.n).T
    normal *= np.sign(np.sum(normal * towards_eye, axis=1, keepdims=True))
    missed = ~np.array(hit.is_valid())
    distance[missed], normal[missed] = np.inf, 0
    number = np.zeros(size * size)
    for shape in world.shapes():
        kind, index = shape.id().split("-")
        if kind == "instance":
            number[np.array(hit.shape == mi.ShapePtr(shape))] = int(index) + 1
    return np.column_stack([distance, normal, number]).reshape(size, size, 5).astype(np.float32)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("scene", type=pathlib.Path)
    parser.add_argument("output")
    parser.add_argument("--spp", type=int, default=1024, help="rounded up to passes of 64 (default 1024)")
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--first-hits", action="store_true")
    options = parser.parse_args()
    scene = json.loads(options.scene.read_text())
    world = load(scene, options.scene.parent)
    if options.first_hits:
        mi.Bitmap(centreHits(world, scene["size"]), mi.Bitmap.PixelFormat.MultiChannel,
                  ["Z", "N.X", "N.Y", "N.Z", "ID"]).write(options.output)
        return
    passes = math.ceil(options.spp / PASS_SPP)
    total = 0
    for i in range(passes):
        total = total + render(world, scene, options.seed * passes + i)
    mi.Bitmap((total / passes).astype(np.float32)).write(options.output)


if __name__ == "__main__":
    main()
