# SPDX-License-Identifier: Apache-2.0
import json
import pathlib
import re
import shutil
import signal
import threading

import numpy as np
import pytest
from conftest import GRID

import pointrt

#: Straight down on the field from 50 m above it: x to the east, y of the picture to the south.
DOWN = np.array([[1.0, 0, 0, GRID[0] + 10], [0, -1, 0, GRID[1] + 10], [0, 0, -1, GRID[2] + 60], [0, 0, 0, 1]])


def test_layers_have_their_shapes_and_types(scene):
    picture = scene.render(width=9, height=6, layers=pointrt.LAYERS, lights=2)
    assert tuple(picture) == pointrt.LAYERS
    shapes = {name: array.shape for name, array in picture.items()}
    assert shapes["rgba"] == (6, 9, 4) and shapes["normal"] == shapes["albedo"] == (6, 9, 3)
    assert shapes["depth"] == shapes["splat_id"] == (6, 9)
    assert {str(array.dtype) for array in picture.values()} == {"float32", "uint32"}
    assert picture["splat_id"].dtype == np.uint32
    assert picture["Z"] is picture["depth"] and picture["id.splat"] is picture["splat_id"]
    assert list(scene.render(width=2, height=2, layers=["Z"], lights=2)) == ["depth"]
    with pytest.raises(KeyError):
        picture["nothing"]


def test_pictures_have_the_memory_of_the_scene(hills_in_tiles):
    tiles = json.loads((pathlib.Path(hills_in_tiles) / "set.json").read_text())["tiles"]
    small = 2 * max(tile["bytes"] for tile in tiles)
    taken = pointrt.Scene(hills_in_tiles, memory=small).render(width=64, height=64, layers=["tile_id"], lights=1)
    whole = pointrt.Scene(hills_in_tiles)
    given = whole.render(width=64, height=64, layers=["tile_id"], lights=1, memory=small)
    np.testing.assert_array_equal(taken["tile_id"], given["tile_id"])
    full = whole.render(width=64, height=64, layers=["tile_id"], lights=1, detail=0)
    assert (full["tile_id"] != taken["tile_id"]).any()


def test_clips_cut_pictures_and_rays(field):
    box = [*(GRID + [0, 0, 0]), *(GRID + [10, 20, 20])]  # the western half
    cut = pointrt.Scene(field, clip=box)
    np.testing.assert_array_equal(cut.clip, [box])
    east, west = GRID + [15, 10, 60], GRID + [5, 10, 60]
    rays = np.array([[*east, 0, 0, -1], [*west, 0, 0, -1]])
    np.testing.assert_allclose(cut.cast_rays(rays)["t_hit"], [np.inf, 50], atol=2e-3)
    camera = pointrt.Camera.from_intrinsics(100, 100, 30, 20, DOWN)  # 2 pixels per metre
    depth = cut.render(camera, 60, 40, layers=["depth"], lights=1)["depth"]
    assert np.isfinite(depth[20, 12:29]).all() and np.isinf(depth[20, 31:]).all()
    for bad in ([0, 0, 0, 1, 1], [0, 0, 0, 1, 0, 1], [0, 0, 0, 1, np.nan, 1], [box] * 6):
        with pytest.raises(ValueError):
            pointrt.Scene(field, clip=bad)


def test_filters_hide_splats_from_pictures_and_rays(field):
    ray = np.array([[*(GRID + [5, 10, 60]), 0, 0, -1]])
    ground = pointrt.Scene(field, only="height=-1e9:1e9")
    np.testing.assert_array_equal(ground.cast_rays(ray)["t_hit"], pointrt.Scene(field).cast_rays(ray)["t_hit"])
    nothing = pointrt.Scene(field, only=["height=-1e9:1e9", "height=1e8:1e9"])
    assert np.isinf(nothing.cast_rays(ray)["t_hit"]).all()
    camera = pointrt.Camera.from_intrinsics(100, 100, 30, 20, DOWN)
    assert np.isinf(nothing.render(camera, 60, 40, layers=["depth"], lights=1)["depth"]).all()
    with pytest.raises(pointrt.Error, match="no scan has an attribute"):
        pointrt.Scene(field, only="klass=2")
    with pytest.raises(ValueError):
        pointrt.Scene(field, only="klass")


def test_sections_show_what_is_behind_the_cut_in_true_scale(hills):
    scene = pointrt.Scene(hills)
    picture = scene.section(f"z={GRID[2] + 1}", 80, 80, layers=["position", "splat_id"], ortho=120, lights=1)
    hit = picture["splat_id"] != pointrt.NO_HIT
    assert 500 < hit.sum() < hit.size and picture["position"][hit, 2].max() < GRID[2] + 1.05
    # parallel projection: 1.5 m from pixel to pixel, in floats that resolve 0.03 m there
    both = hit[:, 1:] & hit[:, :-1]
    np.testing.assert_allclose(np.diff(picture["position"][..., 0], axis=1)[both], 1.5, atol=0.07)
    with pytest.raises(ValueError, match="section"):
        scene.section("z")


def test_points_project_to_their_pixels(scene):
    # 2 pixels per metre at 50 m; the principal point sees (10, 10) of the field
    fx, fy, cx, cy = 100.0, 100.0, 30.0, 12.0
    camera = pointrt.Camera.from_intrinsics(fx, fy, cx, cy, DOWN)
    picture = scene.render(camera, 60, 40, layers=["depth", "position", "splat_id"], lights=1)
    x, y = np.meshgrid(np.arange(60) + 0.5, np.arange(40) + 0.5)
    length = np.sqrt(1 + ((x - cx) / fx) ** 2 + ((y - cy) / fy) ** 2)
    east, south = 50 * (x - cx) / fx, 50 * (y - cy) / fy
    inside = (np.abs(east) < 9.5) & (np.abs(south) < 9.5)
    assert inside.sum() > 500
    np.testing.assert_allclose(picture["depth"][inside], (50 * length)[inside], atol=2e-3)
    outside = (np.abs(east) > 10.5) | (np.abs(south) > 10.5)
    assert np.isinf(picture["depth"][outside]).all()
    assert (picture["splat_id"][outside] == pointrt.NO_HIT).all()
    # the splat of a pixel is at that place
    splats = pointrt.ScanFile(scene._paths[0]).decode()["positions"][picture["splat_id"][inside]]
    np.testing.assert_allclose(splats[:, 0], GRID[0] + 10 + east[inside], atol=0.5)
    np.testing.assert_allclose(splats[:, 1], GRID[1] + 10 - south[inside], atol=0.5)


def test_conventions_and_rows(scene):
    opengl = DOWN * [1, -1, -1, 1]
    same = [scene.render(camera, 30, 20, layers=["depth"], lights=1)["depth"] for camera in (
        pointrt.Camera.from_intrinsics(40, 50, 15, 10, DOWN),
        pointrt.Camera.from_intrinsics(40, 50, 15, 10, opengl, "opengl"),
        pointrt.Camera.from_intrinsics(40, 50, 15, 10, DOWN[:3]))]
    np.testing.assert_array_equal(same[0], same[1])
    np.testing.assert_array_equal(same[0], same[2])


def test_looking_at(scene):
    eye = GRID + [10, 10, 60]
    camera = pointrt.Camera.look_at(eye, GRID + [10, 10, 10], up=[0, 1, 0], fov_deg=2 * np.degrees(np.arctan(0.2)))
    focal = 20 / (2 * 0.2)
    pinhole = pointrt.Camera.from_intrinsics(focal, focal, 15, 10, DOWN)
    looked, machine = (scene.render(each, 30, 20, layers=["depth", "rgba"], lights=1) for each in (camera, pinhole))
    np.testing.assert_allclose(looked["depth"], machine["depth"], rtol=1e-6)
    np.testing.assert_allclose(looked["rgba"], machine["rgba"], atol=1e-4)


def test_settings_decide_the_picture(scene):
    eye = pointrt.Camera.look_at(GRID + [10, 0, 40], GRID + [10, 10, 10])
    colors = scene.render(eye, 8, 8, layers="albedo", lights=1)["albedo"]
    np.testing.assert_allclose(colors[4, 4], [1, 0, 0], atol=0.02)
    normals = scene.render(eye, 8, 8, integrator="normal", spp=1)["rgba"]
    assert not np.array_equal(normals, scene.render(eye, 8, 8, spp=1, lights=1)["rgba"])
    light, dark = (scene.render(eye, 8, 8, shadows=False, lights=number)["rgba"].sum() for number in (4, 0))
    assert light > dark
    few = scene.render(eye, 8, 8, layers=["samples"], spp=np.int64(7), lights=1)["samples"]
    assert (few == 7).all()


@pytest.mark.parametrize("arguments, text", [
    ({"width": 0}, "0 x 512"),
    ({"width": -3}, "0 x 512"),
    ({"height": 2**40}, "512 x 4294967295"),
    ({"layers": ["colour"]}, "layer \"colour\".*rgba"),
    ({"integrator": "radiosity"}, "integrator: .*radiosity.*phong"),
    ({"spp": 0}, "spp: "),
    ({"no_such_setting": 1}, "no_such_setting: "),
])
def test_invalid_pictures(scene, arguments, text):
    with pytest.raises(ValueError, match=text):
        scene.render(**arguments)


def test_invalid_cameras(scene):
    with pytest.raises(ValueError, match=r"eye .*\[3\].*\[2\]"):
        pointrt.Camera.look_at([1, 2])
    with pytest.raises(ValueError, match=r"\[4, 4\] or \[3, 4\], not \[3, 3\]"):
        pointrt.Camera.from_intrinsics(1, 1, 1, 1, np.eye(3))
    with pytest.raises(ValueError, match="convention .*opencv, opengl.*'blender'"):
        pointrt.Camera.from_intrinsics(1, 1, 1, 1, np.eye(4), "blender")
    with pytest.raises(ValueError, match="focal lengths"):
        scene.render(pointrt.Camera.from_intrinsics(0, 1, 1, 1, DOWN), 8, 8)
    with pytest.raises(ValueError, match="mirrored"):
        scene.render(pointrt.Camera.from_intrinsics(5, 5, 1, 1, DOWN * [-1, 1, 1, 1]), 8, 8)
    with pytest.raises(ValueError, match="last row"):
        scene.render(pointrt.Camera.from_intrinsics(5, 5, 1, 1, DOWN + np.eye(4)[::-1]), 8, 8)


def test_threads_share_a_scene(scene):
    expected = scene.render(width=32, height=32, layers=["rgba"], lights=1)["rgba"]
    found = [None] * 4

    def render(k):
        found[k] = scene.render(width=32, height=32, layers=["rgba"], lights=1)["rgba"]

    threads = [threading.Thread(target=render, args=(k,)) for k in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    for each in found:
        np.testing.assert_array_equal(each, expected)


def test_ctrl_c_ends_a_picture_and_leaves_the_scene_usable(scene):
    settings = {"spp": 512, "integrator": "path", "lights": 1}
    first = scene.render(width=2, height=2, **settings)  # the first picture takes longer
    timer = threading.Timer(0.3, signal.raise_signal, [signal.SIGINT])
    timer.start()
    with pytest.raises(KeyboardInterrupt):  # minutes of samples
        scene.render(width=512, height=512, **settings)
    timer.join()
    np.testing.assert_array_equal(scene.render(width=2, height=2, **settings)["rgba"], first["rgba"])


def test_changing_settings_frees_memory(field):
    scene = pointrt.Scene(field)

    def resident():
        with open("/proc/self/statm") as statm:
            return int(statm.read().split()[1]) * 4096

    before = 0
    for k in range(310):
        if k == 10:  # all pools have reached their final size
            before = resident()
        scene.render(width=16, height=16, layers=["depth"], lights=1 + k % 2)
    grown = resident() - before
    # Allocators vary by 8 MB, rarely 30; a leaked renderer would take at least a scene's memory.
    assert grown < 60 * scene.device_bytes, f"300 scenes of {scene.device_bytes} bytes left {grown}"


def test_the_example_of_the_docs(field, tmp_path, monkeypatch):
    text = (pathlib.Path(__file__).parents[2] / "docs" / "MACHINES.md").read_text()
    shutil.copy(field, tmp_path / "site.pro")
    monkeypatch.chdir(tmp_path)
    words = {"world_from_camera": DOWN}
    exec(re.search(r"```python\n(.*?)```", text, re.DOTALL)[1], words)
    assert words["picture"]["depth"].shape == (480, 640)
    assert words["picture"]["depth"][240, 320] == pytest.approx(50, abs=0.01)
