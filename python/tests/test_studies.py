# SPDX-License-Identifier: Apache-2.0
import datetime

import numpy as np
import pytest
from conftest import GRID, plane_points

import pointrt

PLACE = (47.4, 15.0)


@pytest.fixture(scope="module")
def wall(field, tmp_path_factory):
    """A wall from west to east through the middle of the field, 4 m high, facing south."""
    x, z = np.meshgrid((np.arange(200) + 0.5) * 0.1, 10 + (np.arange(40) + 0.5) * 0.1)
    points = GRID + np.stack([x.ravel(), np.full(x.size, 10.0), z.ravel()], axis=1)
    normals = np.tile([0.0, -1.0, 0.0], (len(points), 1))
    return pointrt.bake(points, normals, output=tmp_path_factory.mktemp("scans") / "wall.pro", clean="off")


def test_an_open_field_has_sun_all_day(scene):
    hours = scene.sun_hours(PLACE, "2026-06-21", every=60)
    assert hours.shape == (len(scene),) and hours.dtype == np.float64
    np.testing.assert_array_equal(hours, 16)
    np.testing.assert_array_equal(scene.sun_hours(PLACE, datetime.date(2026, 6, 21), "2026-06-22", every=60), 32)
    np.testing.assert_allclose(scene.sky_view(directions=64), 1)


def test_a_wall_shades_what_lies_north_of_it(field, wall):
    scene = pointrt.Scene([field, wall])
    points = GRID + [[10, 9, 10], [10, 10.5, 10], [10, 19, 10]]
    hours = scene.sun_hours(PLACE, "2026-12-21", every=30, points=points)
    assert hours[0] == pointrt.Scene(field).sun_hours(PLACE, "2026-12-21", every=30, points=points)[0] > 7.5
    assert hours[1] == 0
    # the noon sun at 19 degrees casts a shadow of 12 m
    assert hours[2] < 6
    assert scene.sky_view(points=points)[1] < 0.6
    both = scene.sun_hours(PLACE, "2026-12-21", every=30, points=points.reshape(3, 1, 3), radii=0.1)
    assert both.shape == (3, 1)


def test_normals_decide_which_side_is_lit(scene):
    points = np.tile(GRID + [10, 10, 10.5], (2, 1))
    normals = [[0, 0, 1], [0, 0, -3]]
    hours = scene.sun_hours(PLACE, "2026-06-21", every=60, points=points, normals=normals, sides="front")
    np.testing.assert_array_equal(hours, [16, 0])
    assert scene.sun_hours(PLACE, "2026-06-21", every=60, points=points[1], sides="both").shape == ()


def test_visibility(field, wall):
    scene = pointrt.Scene([field, wall])
    points = GRID + [[10, 5, 10], [10, 12, 10], [10, 10, 15]]
    observers = GRID + [[10, 2, 12], [10, 18, 12]]
    visible = scene.visible_from(observers, points=points, radii=0.1)
    np.testing.assert_array_equal(visible, [[True, False, True], [False, True, True]])
    np.testing.assert_array_equal(scene.visible_from(observers[0], points=points, radius=5), [True, False, False])
    assert scene.visible_from(observers[0] - [0, 0, 8], height=40, points=points).all()
    own = scene.visible_from(observers[:1])
    assert own.shape == (1, len(scene)) and own.dtype == np.bool_ and own.any() and not own.all()


def test_studies_of_a_set_match_one_file(hills, hills_in_tiles):
    whole, tiles = pointrt.Scene(hills), pointrt.Scene(hills_in_tiles, memory=1 << 30)
    points = {scene: np.concatenate([block["positions"] for block in scene.points(1000)]) for scene in (whole, tiles)}
    order = {scene: np.lexsort(np.round((points[scene] - GRID)[:, :2] / 0.4).T) for scene in points}  # by lattice position
    np.testing.assert_allclose(points[tiles][order[tiles]], points[whole][order[whole]], atol=1e-3)
    hours = {scene: scene.sun_hours(PLACE, "2026-12-21", every=30)[order[scene]] for scene in points}
    assert (hours[tiles] == hours[whole]).mean() > 0.995 and 0 == hours[tiles].min() < hours[tiles].max()
    seen = {scene: scene.visible_from(GRID + [50, 50, 8])[order[scene]] for scene in points}
    assert (seen[tiles] == seen[whole]).mean() > 0.99 and 0.1 < seen[tiles].mean() < 0.9
    blocks = list(tiles.points())
    assert sum(len(block["tile_ids"]) for block in blocks) == len(tiles)
    assert len(np.unique(np.concatenate([block["tile_ids"] for block in blocks]))) >= 4


def test_studies_use_placed_instances(field, tmp_path):
    (tmp_path / "two.toml").write_text(f"[[instance]]\nfile = '{field}'\n[[instance]]\nfile = '{field}'\n"
                                       'translate = [0, 0, 5]\n')
    scene = pointrt.Scene(tmp_path / "two.toml")
    (points,) = scene.points()
    np.testing.assert_array_equal(points["instance_ids"], np.repeat([0, 1], len(scene) // 2))
    np.testing.assert_allclose(points["positions"][len(scene) // 2:] - points["positions"][:len(scene) // 2],
                               np.tile([0.0, 0.0, 5.0], (len(scene) // 2, 1)))
    sky = scene.sky_view(directions=64)
    middle = np.linalg.norm(points["positions"][:, :2] - GRID[:2] - 10, axis=1) < 2
    assert (sky[middle & (points["instance_ids"] == 0)] < 0.5).all()
    np.testing.assert_array_equal(sky[points["instance_ids"] == 1], 1)
    with pytest.raises(ValueError, match="most .*1"):
        next(scene.points(0))


@pytest.mark.parametrize("arguments, text", [
    (dict(at=(91, 0), date="2026-06-21"), "latitude"),
    (dict(at=(0, 181), date="2026-06-21"), "longitude"),
    (dict(at=PLACE, date="2026-02-30"), "day is out of range"),
    (dict(at=PLACE, date="2026-06-21", to="2026-06-20"), "last day"),
    (dict(at=PLACE, date="2026-06-21", every=0), "minutes"),
    (dict(at=PLACE, date="2026-06-21", sides="left"), "sides"),
    (dict(at=PLACE, date="2026-06-21", north=[0, 0, 1]), "north"),
    (dict(at=PLACE, date="2026-06-21", points=np.zeros((3, 2))), r"points .*3\].*\[3, 2\]"),
    (dict(at=PLACE, date="2026-06-21", points=np.zeros((3, 3)), normals=np.zeros((2, 3))), "normals .*shape"),
    (dict(at=PLACE, date="2026-06-21", points=np.zeros((3, 3)), radii=np.zeros(2)), "radii .*shape"),
    (dict(at=PLACE, date="2026-06-21", radii=1.0), "normals and radii .*points"),
])
def test_invalid_arguments(scene, arguments, text):
    with pytest.raises(ValueError, match=text):
        scene.sun_hours(**arguments)


def test_points_and_observers_must_be_finite(scene):
    with pytest.raises(pointrt.Error, match="point 1: .*finite"):
        scene.sun_hours(PLACE, "2026-06-21", points=[[0, 0, 0], [0, np.nan, 0]])
    with pytest.raises(ValueError, match="finite"):
        scene.visible_from([0, np.inf, 0])
    with pytest.raises(ValueError, match="radius"):
        scene.visible_from([0, 0, 0], radius=0)


def test_results_do_not_depend_on_blocks(scene, monkeypatch):
    whole = scene.sky_view(directions=16), scene.visible_from(GRID + [3, 3, 30])
    monkeypatch.setattr("pointrt._studies._POINTS_AT_ONCE", 777)
    monkeypatch.setattr("pointrt._studies._RAYS_AT_ONCE", 3000)
    np.testing.assert_array_equal(whole[0], scene.sky_view(directions=16))
    np.testing.assert_array_equal(whole[1], scene.visible_from(GRID + [3, 3, 30]))
    assert len(plane_points()) == len(whole[0])
