# SPDX-License-Identifier: Apache-2.0
import gc

import numpy as np
import pytest
from conftest import GRID, plane_points

import pointrt


def test_arrays_are_views_that_keep_the_file(field):
    file = pointrt.ScanFile(field)
    words = file.splat_words
    assert words.shape == (len(file), 4) and words.dtype == np.uint32 and not words.flags.writeable
    before = words.copy()
    del file
    gc.collect()
    np.testing.assert_array_equal(words, before)


def test_decoded_splats_are_the_points(field):
    splats = pointrt.ScanFile(field).decode()
    points = plane_points()
    assert splats["positions"].dtype == np.float64
    order = np.lexsort(np.round(splats["positions"], 2).T)
    np.testing.assert_allclose(splats["positions"][order], points[np.lexsort(np.round(points, 2).T)], atol=1e-3)
    np.testing.assert_allclose(splats["normals"], np.tile([0, 0, 1], (len(points), 1)), atol=1e-3)
    np.testing.assert_array_equal(splats["colors"], np.tile([255, 0, 0], (len(points), 1)))
    assert (splats["radii"] > 0.1).all() and (splats["radii"] < 0.5).all()


def test_bounds(field):
    low, high = pointrt.ScanFile(field).bounds
    assert np.all(low >= GRID - 1) and np.all(high <= GRID + [21, 21, 11])


def test_attributes_come_with_the_hits(tmp_path):
    points = plane_points(60, 12.0)
    scan = tmp_path / "heat.csv"
    heat = np.arange(len(points)) % 7
    np.savetxt(scan, np.column_stack([points, 200 + heat, heat / 8]), "%.3f,%.3f,%.3f,%d,%.3f",
               header="x,y,z,heat,share", comments="")
    path = pointrt.bake(scan, output=tmp_path / "heat.pro", clean="off")
    scene = pointrt.Scene(path)
    assert scene.attributes == ("heat", "share")
    rays = np.column_stack([points + [0, 0, 5], np.tile([0.0, 0.0, -1.0], (len(points), 1))])
    hits = scene.cast_rays(rays, fields=["splat_ids"], attributes=["heat", "share"])
    assert list(hits) == ["splat_ids", "heat", "share"]
    for name in ("heat", "share"):
        values = pointrt.ScanFile(path).attributes[name]
        assert not values.flags.writeable and hits[name].dtype == values.dtype
        np.testing.assert_array_equal(hits[name], values[hits["splat_ids"]])
    assert hits["heat"].min() == 200 and hits["heat"].max() == 206 and hits["share"].max() == 0.75
    assert np.mean(hits["heat"] == 200 + heat) > 0.99  # straight above a point its own disc is hit first, nearly always
    with pytest.raises(ValueError, match="attribute 'cold'.*heat"):
        scene.cast_rays(rays, attributes=["cold"])


def test_bad_arrays_and_options_of_bakes(tmp_path):
    with pytest.raises(ValueError, match="points .*shape"):
        pointrt.bake(np.zeros((5, 2)), output=tmp_path / "a.pro")
    with pytest.raises(ValueError, match=r"normals .*\[5, 3\]"):
        pointrt.bake(np.zeros((5, 3)), np.zeros((4, 3)), output=tmp_path / "a.pro")
    with pytest.raises(ValueError, match="uint8"):
        pointrt.bake(np.zeros((5, 3)), colors=np.zeros((5, 3)), output=tmp_path / "a.pro")
    with pytest.raises(pointrt.Error, match="no-such-option"):
        pointrt.bake(plane_points(), output=tmp_path / "a.pro", no_such_option=1)
    assert not (tmp_path / "a.pro").exists()
