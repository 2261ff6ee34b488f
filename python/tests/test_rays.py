# SPDX-License-Identifier: Apache-2.0
import threading

import numpy as np
import pytest
from conftest import GRID

import pointrt


def ray(x, y, z, direction):
    return [*(GRID + [x, y, z]), *direction]


def test_a_hit_is_where_the_field_is(scene):
    hits = scene.cast_rays([ray(5, 5, 60, [0, 0, -2]), ray(-5, 5, 60, [0, 0, -1])])
    assert hits["t_hit"].dtype == np.float64
    np.testing.assert_allclose(hits["t_hit"], [25, np.inf], atol=2e-4)
    np.testing.assert_allclose(hits["positions"][0], GRID + [5, 5, 10], atol=2e-4)
    assert np.isnan(hits["positions"][1]).all()
    np.testing.assert_allclose(hits["normals"], [[0, 0, 1], [0, 0, 0]], atol=1e-3)
    assert hits["splat_ids"][0] < len(scene) and hits["splat_ids"][1] == pointrt.NO_HIT == 4294967295
    np.testing.assert_array_equal(hits["instance_ids"], [0, pointrt.NO_HIT])


def test_results_have_the_shape_of_the_rays(scene):
    rays = np.tile(ray(5, 5, 60, [0, 0, -1]), (2, 3, 1))
    hits = scene.cast_rays(rays)
    assert {name: array.shape for name, array in hits.items()} == {
        "t_hit": (2, 3), "splat_ids": (2, 3), "instance_ids": (2, 3), "normals": (2, 3, 3), "positions": (2, 3, 3)}
    assert scene.test_occlusions(rays).shape == (2, 3)
    assert scene.cast_rays(np.empty((0, 6)))["t_hit"].shape == (0,)
    assert scene.cast_rays(rays[0, 0])["t_hit"].shape == ()


def test_only_requested_fields(scene):
    hits = scene.cast_rays([ray(5, 5, 60, [0, 0, -1])], fields=["primitive_ids", "t_hit"])
    assert list(hits) == ["t_hit", "splat_ids"]
    assert hits["primitive_ids"] is hits["splat_ids"]
    with pytest.raises(KeyError):
        hits["normals"]
    with pytest.raises(ValueError, match="field 'colour'"):
        scene.cast_rays(np.empty((0, 6)), fields=["colour"])


def test_limits(scene):
    rays = [ray(5, 5, 60, [0, 0, -1])]
    assert scene.test_occlusions(rays).tolist() == [True]
    assert scene.test_occlusions(rays, t_max=49).tolist() == [False]
    assert scene.test_occlusions(rays, t_min=51).tolist() == [False]
    assert np.isinf(scene.cast_rays(rays, t_max=49)["t_hit"]).all()
    with pytest.raises(ValueError):
        scene.cast_rays(rays, t_min=2, t_max=1)


def test_floats_and_strided_arrays(scene):
    wide = np.zeros((4, 12), np.float32)
    wide[:, ::2] = np.float32(ray(5, 5, 60, [0, 0, -1]))
    np.testing.assert_allclose(scene.cast_rays(wide[:, ::2])["t_hit"], 50, atol=1)


@pytest.mark.parametrize("rays, error, text", [
    (np.zeros((3, 5)), ValueError, r"shape \[..., 6\], not \[3, 5\]"),
    (np.zeros((3, 6), np.int64), TypeError, "float32 or float64, not int64"),
    (np.zeros((3, 6), complex), TypeError, "complex128"),
    (np.float64(1), ValueError, "shape"),
    ([ray(0, 0, 60, [0, 0, -1]), ray(0, 0, 60, [0, 0, 0])], ValueError, "ray 1: "),
    ([ray(0, 0, 60, [0, 0, -1]), ray(0, np.nan, 60, [0, 0, -1])], ValueError, "ray 1: "),
    (["nothing"], ValueError, "nothing"),
])
def test_invalid_rays(scene, rays, error, text):
    with pytest.raises(error, match=text):
        scene.cast_rays(rays)
    with pytest.raises(error, match=text):
        scene.test_occlusions(rays)


def test_invalid_rays_are_numbered_across_parts(scene, monkeypatch):
    monkeypatch.setattr("pointrt._scene._RAYS_AT_ONCE", 4)
    rays = np.tile(ray(5, 5, 60, [0, 0, -1]), (11, 1))
    np.testing.assert_allclose(scene.cast_rays(rays)["t_hit"], 50, atol=2e-4)
    assert scene.test_occlusions(rays).all()
    rays[9, 3:] = 0
    with pytest.raises(ValueError, match="ray 9: "):
        scene.cast_rays(rays)


def test_from_many_threads(scene):
    rng = np.random.default_rng(1)
    rays = np.concatenate([GRID + rng.uniform([-5, -5, 20], [25, 25, 90], (20000, 3)),
                           np.tile([0.0, 0.0, -1.0], (20000, 1))], axis=1)
    expected = scene.cast_rays(rays)["splat_ids"]
    found = [None] * 8

    def cast(k):
        found[k] = scene.cast_rays(rays)["splat_ids"]

    threads = [threading.Thread(target=cast, args=(k,)) for k in range(8)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    for each in found:
        np.testing.assert_array_equal(each, expected)


def test_several_scans(field):
    scene = pointrt.Scene([field, field])
    assert len(scene) == 2 * len(pointrt.ScanFile(field))
    assert scene.cast_rays([ray(5, 5, 60, [0, 0, -1])])["instance_ids"][0] in (0, 1)


def test_missing_scenes(tmp_path):
    with pytest.raises(pointrt.Error, match="nothing.pro: "):
        pointrt.Scene(tmp_path / "nothing.pro")
    text = tmp_path / "text.pro"
    text.write_text("no scan")
    with pytest.raises(pointrt.Error, match="text.pro: "):
        pointrt.Scene([text])
    with pytest.raises(ValueError):
        pointrt.Scene([])
    with pytest.raises(pointrt.Error):
        pointrt.Device("no such device")
