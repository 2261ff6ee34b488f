# SPDX-License-Identifier: Apache-2.0
import json
import pathlib
import shutil

import numpy as np
import pytest
from conftest import GRID

import pointrt


def down(x, y):
    return [*(GRID + [x, y, 60]), 0, 0, -1]


def rays_over_hills(count=20000):
    rng = np.random.default_rng(1)
    origins = GRID + rng.uniform([-10, -10, -4], [110, 110, 20], (count, 3))
    return np.concatenate([origins, rng.normal(size=(count, 3)) * [1, 1, 0.3]], axis=1)


def tiles_of(folder):
    return json.loads((pathlib.Path(folder) / "set.json").read_text())["tiles"]


def originals_of(folder):
    return [tile for tile in tiles_of(folder) if tile["error"] == 0]


def test_hits_of_sets_have_tile_ids(hills_in_tiles):
    scene = pointrt.Scene(hills_in_tiles)
    assert scene.has_tiles and scene.instance_count == 1
    tiles = tiles_of(hills_in_tiles)
    hits = scene.cast_rays(rays_over_hills())
    assert hits["tile_ids"].dtype == np.uint32
    hit = np.isfinite(hits["t_hit"])
    assert 0.1 < hit.mean() < 0.9
    np.testing.assert_array_equal(hits["tile_ids"] != pointrt.NO_HIT, hit)
    assert len(np.unique(hits["tile_ids"][hit])) >= 4
    assert hits["tile_ids"][hit].max() < len(tiles)


def test_hits_are_the_same_in_any_memory(hills_in_tiles):
    whole = pointrt.Scene(hills_in_tiles)
    streamed = pointrt.Scene(hills_in_tiles, memory=max(tile["bytes"] for tile in originals_of(hills_in_tiles)))
    rays = rays_over_hills()
    expected, found = whole.cast_rays(rays), streamed.cast_rays(rays)
    for name, array in expected.items():
        np.testing.assert_array_equal(found[name], array, err_msg=name)
    np.testing.assert_array_equal(streamed.test_occlusions(rays), whole.test_occlusions(rays))
    assert streamed.tile_loads > whole.tile_loads
    with pytest.raises(ValueError, match="one tile .*limit"):
        pointrt.Scene(hills_in_tiles, memory=4096)


def test_scene_files(field, tmp_path):
    (tmp_path / "scene.toml").write_text(
        f"[[instance]]\nfile = '{field}'\n"
        f"[[instance]]\nfile = '{field}'\ntranslate = [0, 0, 5]\n"
        f'[[shape]]\ntype = "plane"\npoint = [0, 0, 20]\nnormal = [0, 0, 1]\nmaterial = "ground"\n'
        f'[material.ground]\ncolor = [1, 1, 1]\n')
    scene = pointrt.Scene(tmp_path / "scene.toml")
    assert scene.instance_count == 2 and not scene.has_tiles
    hits = scene.cast_rays([down(5, 5), down(-50, 5)])
    assert list(hits) == ["t_hit", "splat_ids", "instance_ids", "normals", "positions"]
    np.testing.assert_allclose(hits["t_hit"], [45, 140], atol=2e-4)  # the upper field, and the plane below
    np.testing.assert_array_equal(hits["instance_ids"], [1, 255])
    assert hits["splat_ids"][1] == pointrt.NO_HIT
    (tmp_path / "wrong.toml").write_text('[[instance]]\nfile = "gone.pro"\n')
    with pytest.raises(pointrt.Error, match=r'wrong.toml:2: key "instance\[0\].file": .*gone.pro'):
        pointrt.Scene(tmp_path / "wrong.toml")


def test_a_set_that_lacks_a_tile(hills_in_tiles, tmp_path):
    copy = pathlib.Path(shutil.copytree(hills_in_tiles, tmp_path / "copy.proset", copy_function=shutil.copyfile))
    tile = copy / originals_of(copy)[0]["file"]
    tile.unlink()
    with pytest.raises(pointrt.Error, match=f"{tile.name}: No such file"):
        pointrt.Scene(copy)
