# SPDX-License-Identifier: Apache-2.0
"""Renders the caustic of a "caustic" scene by tracing light: render_caustic.py SCENE.json OUT.exr
[--photons MILLIONS] [--seed N]

Traces light from the lamp towards the bodies with Mitsuba's surfaces. Light that reaches the floor by way of a body is
added to the pixel that sees that place, without a kernel and so without blur. Paths from the eye (render_mitsuba.py)
find the same light hundreds of times less often. The floor is y = 0 and reflects no light to the bodies. Pixels that show
a body hold the light of the floor behind it. The EXR is linear: R, G, B.
"""

import argparse
import json
import math
import pathlib

import drjit as dr
import mitsuba as mi
import numpy as np

import meshes
import render_mitsuba

BATCH = 1 << 22


def boundingSphere(scene, folder):
    """Centre and radius of a sphere around the scene's one body."""
    for shape in scene["shapes"]:
        if shape["type"] == "sphere":
            return np.array(shape["center"], float), shape["radius"]
    body, = scene["instances"]
    positions, _, _ = meshes.readPly(folder / (body["mesh"] + ".ply"))
    middle = (positions.min(axis=0) + positions.max(axis=0)) / 2
    radius = np.linalg.norm(positions - middle, axis=1).max()
    return middle * body["scale"] + np.array(body["translate"]), float(radius * body["scale"] * 1.0001)


def emit(lamp, target, numbers):
    """Rays from the spherical lamp into the cone around the target, and the flux of each times the number of rays."""
    centre, radius = target
    out = mi.warp.square_to_uniform_sphere(numbers.next_2d())
    origin = mi.Point3f(lamp["center"]) + out * lamp["radius"] * 1.0001
    way = mi.Point3f(*centre.tolist()) - origin
    distance = dr.norm(way)
    cap = 1 - dr.sqrt(1 - (radius / distance) ** 2)
    local = mi.warp.square_to_uniform_cone(numbers.next_2d(), 1 - cap)
    direction = mi.Frame3f(way / distance).to_world(local)
    area = 4 * math.pi * lamp["radius"] ** 2
    flux = dr.maximum(dr.dot(out, direction), 0) * (area * 2 * math.pi * cap)
    return mi.Ray3f(origin, direction), mi.Color3f(lamp["radiance"]) * flux


@dr.syntax
def followSharp(world, ray, flux, numbers, bounces):
    """Where rays end after mirrors and glass: positions and fluxes (0 if a ray hit no body, or nothing after it)."""
    context = mi.BSDFContext(mi.TransportMode.Importance)
    bounce, going, place, kept = mi.UInt32(0), mi.Bool(True), mi.Point3f(0), mi.Color3f(0)
    ray, flux = mi.Ray3f(ray), mi.Color3f(flux)
    while going:
        hit = world.ray_intersect(ray, going)
        surface = hit.bsdf()
        stays = hit.is_valid() & mi.has_flag(surface.flags(), mi.BSDFFlags.Smooth)
        if stays & (bounce > 0):
            place, kept = hit.p, flux
        drawn, weight = surface.sample(context, hit, numbers.next_1d(), numbers.next_2d(), going)
        flux = flux * weight
        ray = hit.spawn_ray(hit.to_world(drawn.wo))
        going = going & hit.is_valid() & ~stays & (bounce < bounces) & (dr.max(flux) > 0)
        bounce += 1
    return place, kept


def filmPlaces(camera, size, place):
    """Pixel coordinates of points of the floor, and film area in pixels per floor area there."""
    eye, target, up = (np.array(camera[key], float) for key in ("eye", "target", "up"))
    ahead = meshes.normalize(target - eye)
    right = meshes.normalize(np.cross(ahead, up))
    down = np.cross(ahead, right)
    way = place - mi.Point3f(*eye.tolist())
    depth, across, along = (dr.dot(way, mi.Vector3f(*axis.tolist())) for axis in (ahead, right, down))
    pixels_at_one = size / (2 * math.tan(math.radians(camera["fov"]) / 2))
    # A floor patch fills solid angle cosine / distance^2, and film at depth 1 solid angle cos^3 of the angle off axis.
    density = pixels_at_one**2 * dr.abs(way.y) / depth**3
    return size / 2 + pixels_at_one * across / depth, size / 2 + pixels_at_one * along / depth, density


def countInPixels(scene, place, flux):
    """(size, size, 3): radiance of the floor."""
    size = scene["size"]
    x, y, density = filmPlaces(scene["camera"], size, place)
    on_floor = (dr.abs(place.y) < 1e-4) & (dr.max(flux) > 0)
    inside = on_floor & (x >= 0) & (x < size) & (y >= 0) & (y < size)
    pixel = mi.UInt32(dr.clip(y, 0, size - 1)) * size + mi.UInt32(dr.clip(x, 0, size - 1))
    albedo = scene["materials"][scene["shapes"][0]["material"]]["color"]
    light = flux * mi.Color3f(albedo) * (density / math.pi)
    channels = []
    for channel in range(3):
        sums = dr.zeros(mi.Float, size * size)
        dr.scatter_add(sums, light[channel], pixel, inside)
        channels.append(np.array(sums, dtype=np.float64).reshape(size, size))
    return np.stack(channels, axis=2)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("scene", type=pathlib.Path)
    parser.add_argument("output")
    parser.add_argument("--photons", type=int, default=1000, help="millions (default 1000)")
    parser.add_argument("--seed", type=int, default=0)
    options = parser.parse_args()
    scene = json.loads(options.scene.read_text())
    world = render_mitsuba.load(scene, options.scene.parent)
    target, (lamp,) = boundingSphere(scene, options.scene.parent), scene["lights"]
    batches = math.ceil(options.photons * 1e6 / BATCH)
    total = 0
    for batch in range(batches):
        numbers = mi.load_dict({"type": "independent"})
        numbers.seed(options.seed * batches + batch, BATCH)
        ray, flux = emit(lamp, target, numbers)
        place, kept = followSharp(world, ray, flux, numbers, scene["bounces"])
        total = total + countInPixels(scene, place, kept) / BATCH
    mi.Bitmap((total / batches).astype(np.float32)).write(options.output)


if __name__ == "__main__":
    main()
