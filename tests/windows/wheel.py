# SPDX-License-Identifier: Apache-2.0
"""wheel.py FOLDER

Writes hits, pictures and errors that the package computes into FOLDER, from the files that names.txt lists.
"""
import os
import pathlib
import sys

import numpy as np

import pointrt

folder = pathlib.Path(sys.argv[1])
x, y = np.meshgrid(np.arange(60) / 4, np.arange(60) / 4)  # exact, like all numbers here: the C libraries' sines differ
points = np.stack([x.ravel(), y.ravel(), ((x * 3 + y) % 4).ravel()], axis=1) + [500000, 4500000, 100]
rays = np.concatenate([points[::7] + [0.125, 0.0625, 20], np.tile([0.25, 0.125, -1], (len(points[::7]), 1))], axis=1)

for number, name in enumerate(pathlib.Path("names.txt").read_text("utf-8").splitlines()):
    path = pointrt.bake(points, output=f"{name}.pro", force=True)
    (folder / f"{number}.pro").write_bytes(pathlib.Path(path).read_bytes())
    scene_file = pathlib.Path(f"{name}.toml")
    scene_file.write_text(f"[[instance]]\nfile = '{scene_file.stem}.pro'\n", "utf-8")
    scene = pointrt.Scene(scene_file)
    for field, values in scene.cast_rays(rays).items():
        np.save(folder / f"{number}.{field}.npy", values)
    picture = scene.render(width=64, height=48, layers=["rgba", "depth"], spp=4)
    for layer in ("rgba", "depth"):
        np.save(folder / f"{number}.{layer}.npy", picture[layer])
    assert len(pointrt.ScanFile(path)) == len(scene)
    try:
        pointrt.bake(f"{name}.gone", output=f"{name} 2.pro")
    except pointrt.Error as error:
        assert f"{os.path.basename(name)}.gone" in str(error), ascii(error)
    else:
        raise AssertionError("no error")
try:
    pointrt.Scene("gone ü 😀.pro")
except pointrt.Error as error:
    (folder / "error.txt").write_text(str(error).split(":")[0], "utf-8")
