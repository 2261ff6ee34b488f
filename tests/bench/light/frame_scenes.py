# SPDX-License-Identifier: Apache-2.0
"""Writes what frames.sh renders: frame_scenes.py FOLDER MESH.ply [--size PIXELS]

FOLDER gets mesh.ply, MESH with smooth normals in a unit sphere around the origin, and for each scene NAME.json and
NAME.toml as make_scenes.py writes them. The rooms and their lights are those of pointrt-view's --room.
"""

import argparse
import json
import math
import pathlib

import mitsuba as mi
import numpy as np

import make_scenes
import meshes

mi.set_variant("llvm_ad_rgb")

EYE = [0.9, 0.7, 2.8]
# A sphere of radius 1 fits at that distance.
CAMERA = {"eye": EYE, "target": [0, 0, 0], "up": [0, 1, 0], "fov": 38}
BODY = {"kind": "matte", "color": [0.7, 0.7, 0.7]}
MATTE_WALL = {"kind": "matte", "color": [0.42, 0.42, 0.43]}
MIRROR_WALL = {"kind": "mirror", "color": [0.9, 0.9, 0.88]}
GLASS = {"kind": "glass", "color": [1, 1, 1], "index": 1.5}


def room(floor, half_width, height):
    """A box that the eye is in."""
    far = max(half_width, max(EYE) + 0.05)
    return {"type": "box", "min": [-half_width, floor, -half_width], "max": [half_width, floor + height, far],
            "material": "wall"}


def ring(count=3):
    """Point lights that together give a white surface at the origin that faces them a radiance of 1.5."""
    lights = []
    for i in range(count):
        angle = math.radians(-40) + 2 * math.pi * i / count
        strength = math.pi * 1.5 / count * (1.5**2 + 1.9**2)
        place = [1.5 * math.sin(angle), 1.9, 1.5 * math.cos(angle)]
        lights.append({"type": "point", "position": place, "intensity": [strength] * 3})
    return lights


def ceilingLamp(center, half, radiance):
    """A lamp that faces down. Nothing is above it, so its other side does not matter."""
    return {"type": "quad", "center": center, "u": [half, 0, 0], "v": [0, 0, half], "radiance": [radiance] * 3}


def ground(floor, half):
    return {"type": "quad", "center": [0, floor, 0], "u": [half, 0, 0], "v": [0, 0, -half], "material": "wall"}


def makeScenes(floor):
    lamps = [ceilingLamp([-2, 3, 1.5], 0.5, 9), ceilingLamp([2.5, 2.5, 1], 0.8, 2), ceilingLamp([0.5, 2.5, -2.5], 0.5, 5)]
    def scene(body, wall, shape, lights, bounces, integrator="path"):
        return {"camera": CAMERA, "materials": {"body": body, "wall": wall}, "shapes": [shape], "lights": lights,
                "instances": [{"mesh": "mesh", "material": "body", "translate": [0, 0, 0], "scale": 1}],
                "sky": [0, 0, 0], "bounces": bounces, "integrator": integrator}
    return {
        "room": scene(BODY, MATTE_WALL, room(floor, 3.6, 5), ring(), 4),
        "studio": scene(BODY, MATTE_WALL, ground(floor, 12), lamps, 0, "phong"),
        "mirrors": scene(BODY, MIRROR_WALL, room(floor, 1.8, 3), ring(), 10),
        "glass": scene(GLASS, MATTE_WALL, ground(floor, 12), [ceilingLamp([0, 3, 0.5], 1.5, 4)], 8),
    }


def readMesh(path):
    """Any PLY in the unit sphere, and normals that are means of the facets' by area."""
    shape = mi.load_dict({"type": "ply", "filename": str(path)})
    values = mi.traverse(shape)
    positions = np.array(values["vertex_positions"], float).reshape(-1, 3)
    faces = np.array(values["faces"]).reshape(-1, 3).astype(np.int32)
    positions -= (positions.min(axis=0) + positions.max(axis=0)) / 2
    positions /= np.linalg.norm(np.ptp(positions, axis=0)) / 2
    a, b, c = (positions[faces[:, i]] for i in range(3))
    across = np.cross(b - a, c - a)
    normals = np.zeros_like(positions)
    for i in range(3):
        np.add.at(normals, faces[:, i], across)
    return positions, normals / np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-30), faces


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("mesh", type=pathlib.Path)
    parser.add_argument("--size", type=int, default=512, help="pixels of a side (default 512)")
    options = parser.parse_args()
    mesh = readMesh(options.mesh)
    meshes.writePly(options.folder / "mesh.ply", *mesh)
    for name, scene in makeScenes(float(mesh[0][:, 1].min())).items():
        (options.folder / f"{name}.json").write_text(json.dumps({**scene, "size": options.size}, indent=1))
        (options.folder / f"{name}.toml").write_text(make_scenes.sceneToml(scene, options.size))


if __name__ == "__main__":
    main()
