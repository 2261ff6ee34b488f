# SPDX-License-Identifier: Apache-2.0
"""Writes the scenes for all renderers: make_scenes.py FOLDER [--size PIXELS] [--spacing PIXELS]

FOLDER gets MESH.ply and MESH.samples (how many points to bake) for each mesh, and for each scene NAME.json for the
reference renderers and NAME.toml for pointrt-view, which looks for MESH.pro beside it.
"""

import argparse
import json
import math
import pathlib

import numpy as np

import meshes
import scenes


CAUSTIC_SPACING_PX = 1


def listed(values):
    return "[" + ", ".join(f"{value:g}" for value in values) + "]"


def entry(key, value):
    if isinstance(value, str):
        return f'{key} = "{value}"'
    return f"{key} = {listed(value) if isinstance(value, (list, tuple)) else format(value, 'g')}"


def table(heading, values):
    return "\n".join([heading] + [entry(key, value) for key, value in values.items()]) + "\n"


def sceneToml(scene, size):
    """The scene as docs/SCENES.md describes it."""
    parts = [table("[camera]", scene["camera"])]
    parts.append(table("[render]", {"integrator": "path", "size": [size, size], "bounces": scene["bounces"]}))
    parts.append(table("[sky]", {"color": scene["sky"]}))
    parts += [table(f"[material.{name}]", material) for name, material in scene["materials"].items()]
    for instance in scene["instances"]:
        values = {"file": instance["mesh"] + ".pro"} | {k: v for k, v in instance.items() if k != "mesh"}
        parts.append(table("[[instance]]", values))
    parts += [table("[[shape]]", shape) for shape in scene["shapes"]]
    parts += [table("[[light]]", light) for light in scene["lights"]]
    return "\n".join(parts)


def samplesFor(name, mesh, size, spacing_px):
    """The number of points for a spacing of spacing_px pixels where a body is nearest to the camera, in any scene."""
    positions, _, faces = mesh
    most = 0
    for scene in scenes.SCENES.values():
        camera = scene["camera"]
        pixels_at_one = scene.get("size", size) / (2 * math.tan(math.radians(camera["fov"]) / 2))
        for instance in scene["instances"]:
            if instance["mesh"] != name:
                continue
            placed = positions * instance["scale"] + np.array(instance["translate"])
            # A body may be coarser if only its light is compared.
            spacing = max(spacing_px, CAUSTIC_SPACING_PX) if "caustic" in scene else spacing_px
            nearest = np.linalg.norm(placed - np.array(camera["eye"]), axis=1).min()
            most = max(most, meshes.area(placed, faces) * (pixels_at_one / nearest / spacing) ** 2)
    return math.ceil(most)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--size", type=int, default=512, help="pixels of a side (default 512)")
    parser.add_argument("--spacing", type=float, default=0.5, help="of the points, in pixels (default 0.5)")
    options = parser.parse_args()
    options.folder.mkdir(parents=True, exist_ok=True)
    for name, make in meshes.MAKERS.items():
        mesh = make()
        meshes.writePly(options.folder / f"{name}.ply", *mesh)
        samples = samplesFor(name, mesh, options.size, options.spacing)
        (options.folder / f"{name}.samples").write_text(f"{samples}\n")
    for name, scene in scenes.SCENES.items():
        size = scene.get("size", options.size)
        (options.folder / f"{name}.json").write_text(json.dumps({**scene, "size": size}, indent=1))
        (options.folder / f"{name}.toml").write_text(sceneToml(scene, size))


if __name__ == "__main__":
    main()
