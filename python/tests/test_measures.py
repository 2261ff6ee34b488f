# SPDX-License-Identifier: Apache-2.0
import numpy as np
import pytest
from conftest import GRID, plane_points

import pointrt


def test_paths_and_fits_keep_national_coordinates():
    path = pointrt.measure_path(GRID + [[0, 0, 0], [3, 4, 12]])
    assert path["last_leg"] == pytest.approx(13) and path["horizontal"] == pytest.approx(5)
    assert path["height"] == pytest.approx(12) and path["area"] is None
    roof = pointrt.measure_path(GRID + [[0, 0, 0], [4, 0, 0], [4, 4, 3], [0, 4, 3]])
    assert roof["area"] == pytest.approx(20) and roof["plan_area"] == pytest.approx(16)
    assert roof["angle_deg"] == pytest.approx(90)
    angles = np.array([0.1, 1.0, 2.5])
    circle = pointrt.fit_circle(GRID + np.stack([2 * np.cos(angles), 2 * np.sin(angles), 0 * angles], axis=1))
    assert circle["radius"] == pytest.approx(2, abs=1e-7)
    np.testing.assert_allclose(circle["center"], GRID, atol=1e-7)
    np.testing.assert_allclose(pointrt.fit_plane(GRID + [[0, 0, 0], [1, 0, 0], [0, 1, 0]])["normal"], [0, 0, 1])
    sphere = pointrt.fit_sphere(GRID + [[1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, 0, 1]])
    assert sphere["radius"] == pytest.approx(1, abs=1e-7)
    with pytest.raises(ValueError, match="line"):
        pointrt.fit_circle([[0, 0, 0], [1, 1, 1], [2, 2, 2]])
    with pytest.raises(ValueError, match="shape"):
        pointrt.measure_path([1, 2, 3])


def test_volume_over_a_base(scene):
    rim = GRID + [[5, 5, 10], [15, 5, 10], [15, 15, 10], [5, 15, 10]]
    volume = scene.volume(rim, base_height=GRID[2] + 9, cell=0.05)
    assert volume["cut"] == pytest.approx(100, rel=1e-4) and volume["fill"] == 0
    assert volume["covered"] == pytest.approx(volume["area"])
    assert scene.volume(rim)["net"] == pytest.approx(0, abs=0.01)


def test_contours_of_the_field(scene):
    rises = scene.contours(0.5, cell=0.5, up=[0.1, 0, np.sqrt(0.99)])  # level ground seen as a slope
    heights = [line["height"] for line in rises]
    assert heights == sorted(heights) and len(set(heights)) > 3
    for line in rises:
        assert line["positions"].shape[1] == 3
        np.testing.assert_allclose(line["positions"] @ [0.1, 0, np.sqrt(0.99)], line["height"], atol=1e-6)
    assert {line["height"] for line in rises if line["index"]} == {h for h in heights if h % 2.5 == 0}
    with pytest.raises(ValueError):
        scene.contours(-1)


def test_sections_of_the_field(scene):
    lines = scene.section_lines("x=500010")
    assert len(lines) == 1 and not lines[0]["closed"]
    np.testing.assert_allclose(lines[0]["positions"][:, 0], 500010, atol=1e-6)
    np.testing.assert_allclose(lines[0]["positions"][:, 2], GRID[2] + 10, atol=1e-3)
    assert np.linalg.norm(np.diff(lines[0]["positions"], axis=0), axis=1).sum() == pytest.approx(20, abs=0.4)
    slope = scene.section_lines(height=GRID @ [0.6, 0, 0.8] + 14, up=[0.6, 0, 0.8])  # x = 10 on the field
    np.testing.assert_allclose(slope[0]["positions"][:, 0], GRID[0] + 10, atol=2e-2)
    assert scene.section_lines("z=150") == []
    for wrong in ({}, {"plane": "x=1", "height": 1.0}, {"plane": "x=1:0.5"}, {"height": 1.0, "step": 0.0}):
        with pytest.raises(ValueError):
            scene.section_lines(**wrong)


def test_profile_of_the_field(scene):
    profile = scene.profile(GRID + [[-5, 10, 0], [15, 10, 0]], step=0.5)
    assert profile["hits"].dtype == np.bool_ and len(profile["stations"]) == 41
    inside = profile["positions"][:, 0] > GRID[0] + 0.5
    np.testing.assert_allclose(profile["heights"][inside], GRID[2] + 10, atol=1e-3)
    assert np.isnan(profile["heights"][0]) and not profile["hits"][0]


def test_a_moved_scan_is_compared(scene, tmp_path):
    points = plane_points() + [0, 0, 0.01]
    normals = np.tile([0.0, 0.0, 1.0], (len(points), 1))
    moved = pointrt.Scene(pointrt.bake(points, normals, output=tmp_path / "moved.pro"))
    np.testing.assert_allclose(scene.distances(moved, max_distance=1), 0.01, atol=1e-3)
    np.testing.assert_allclose(moved.distances(scene, max_distance=1), -0.01, atol=1e-3)
    some = slice(4000, 4010)
    np.testing.assert_allclose(scene.distances(points[some] + [0, 0, 0.2], normals[some]), 0.21, atol=1e-3)
    with pytest.raises(ValueError, match="normals"):
        scene.distances(points)


def test_points_snap(scene):
    snapped = scene.snap(GRID + [[10, 10, 12], [5, 5, 9]])
    np.testing.assert_allclose(snapped, GRID + [[10, 10, 10], [5, 5, 10]], atol=1e-2)
    below = scene.snap(GRID + [[10, 10, 2], [-10, 0, 0]], along=[0, 0, 2])
    np.testing.assert_allclose(below[0], GRID + [10, 10, 10], atol=1e-3)
    assert np.isnan(below[1]).all()
