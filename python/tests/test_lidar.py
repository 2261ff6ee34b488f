# SPDX-License-Identifier: Apache-2.0
import signal
import threading

import numpy as np
import pytest
from conftest import GRID

import pointrt

#: 5 m over the middle of the field, which is 10 m over GRID.
MIDDLE = (GRID + [10, 10, 15]).tolist()
SENSOR = {
    "spinning": {"elevations_deg": [-90, -60, -45], "rotation_hz": 10, "step_deg": 10},
    "range": {"max_m": 50},
    "intensity": {"reflectance": 0.5, "reference_m": 5},
}
TYPES = {"positions": np.float64, "times": np.float64, "ranges": np.float64, "intensities": np.uint16,
         "powers": np.float32, "incidences_deg": np.float32, "scan_angles_deg": np.float32,
         "return_numbers": np.uint8, "numbers_of_returns": np.uint8, "rings": np.uint16, "pulses": np.uint64,
         "splat_ids": np.uint32, "instance_ids": np.uint32}


def test_ranges_are_those_of_the_field(scene):
    points = scene.simulate_lidar(SENSOR, pose=MIDDLE)
    assert {name: array.dtype for name, array in points.items()} == TYPES
    assert points["positions"].shape == (36 * 3, 3)
    down = np.sin(np.radians([90, 60, 45]))[points["rings"]]
    np.testing.assert_allclose(points["ranges"], 5 / down, atol=1e-3)
    np.testing.assert_allclose(points["positions"][:, 2], GRID[2] + 10, atol=1e-3)
    np.testing.assert_allclose(points["powers"], 0.5 * down**3, atol=2e-3)
    np.testing.assert_allclose(points["times"], np.repeat(np.arange(36), 3) / 360, atol=1e-9)
    assert (points["splat_ids"] < len(scene)).all() and (points["return_numbers"] == 1).all()


def test_a_trajectory_is_followed(scene, tmp_path):
    sensor = {**SENSOR, "spinning": {"elevations_deg": [-90], "rotation_hz": 10, "step_deg": 36}}
    rows = np.array([[2, *MIDDLE, 0, 0, 0, 1], [4, *(np.array(MIDDLE) + [4, 0, 0]), 0, 0, 0, 1]])
    points = scene.simulate_lidar(sensor, rows)
    assert len(points["times"]) == 200
    np.testing.assert_allclose(points["positions"][:, 0], MIDDLE[0] + 2 * (points["times"] - 2), atol=1e-3)
    again = scene.simulate_lidar(sensor, np.concatenate([rows[:, :4], np.zeros((2, 3))], axis=1))
    np.testing.assert_array_equal(again["positions"], points["positions"])
    file = tmp_path / "drive.csv"
    np.savetxt(file, rows, header="t,x,y,z,qx,qy,qz,qw", comments="", delimiter=",", fmt="%.17g")
    np.testing.assert_array_equal(scene.simulate_lidar(sensor, file)["positions"], points["positions"])
    part = scene.simulate_lidar(sensor, rows, start=3, duration=0.5)
    np.testing.assert_allclose(part["times"], 3 + np.arange(50) / 100, atol=1e-9)


def test_a_sensor_file_can_have_a_pose(scene, tmp_path):
    file = tmp_path / "sensor.toml"
    file.write_text("[flash]\npixels = [4, 4]\nfield_of_view_deg = [20, 20]\nframe_hz = 1\n[range]\nmax_m = 50\n"
                    f"[pose]\nposition = {MIDDLE}\npitch_deg = 90\n")
    assert len(scene.simulate_lidar(file)["times"]) == 16
    assert len(scene.simulate_lidar(str(file), pose=[*MIDDLE, 0, -90, 0])["times"]) == 0


def test_seeds_determine_the_points(scene):
    sensor = {**SENSOR, "range": {"max_m": 50, "noise_m": 0.1}, "detection": {"drop_probability": 0.2}}
    one, same, other = (scene.simulate_lidar(sensor, pose=MIDDLE, seed=seed) for seed in (1, 1, 2))
    np.testing.assert_array_equal(one["positions"], same["positions"])
    assert len(one["pulses"]) != len(other["pulses"]) or (one["ranges"] != other["ranges"]).any()


def test_units_of_the_scan(scene):
    near = {**SENSOR, "range": {"max_m": 1.6}}  # 5 units of 0.3 m are 1.5 m
    assert len(scene.simulate_lidar(near, pose=MIDDLE)["times"]) == 0
    assert set(scene.simulate_lidar(near, pose=MIDDLE, metres_per_unit=0.3)["rings"]) == {0}


@pytest.mark.parametrize("change, text", [
    ({"spinning": {"elevations_deg": [0], "rotation_hz": -1, "step_deg": 1}}, r"spinning.rotation_hz.*is -1"),
    ({"range": {"max": 1}}, r"key .max., .*max_m"),
    ({"rang": {}}, r"key .rang., .*.range."),
    ({"detection": {"threshold": float("nan")}}, "is nan"),
])
def test_invalid_sensors(scene, change, text):
    with pytest.raises(ValueError, match=text):
        scene.simulate_lidar({**SENSOR, **change}, pose=MIDDLE)


def test_tile_sets(hills_in_tiles):
    scene = pointrt.Scene(hills_in_tiles)
    points = scene.simulate_lidar(SENSOR, pose=GRID + [50, 50, 15])
    assert (points["tile_ids"] != pointrt.NO_HIT).all() and len(set(points["tile_ids"].tolist())) > 1
    at = points["positions"] - GRID
    np.testing.assert_allclose(at[:, 2], 5 * np.sin(at[:, 0] / 8) * np.cos(at[:, 1] / 9), atol=0.1)


def test_invalid_trajectories_and_attributes(scene, tmp_path):
    def refused(error, text, *args, **options):
        with pytest.raises(error, match=text):
            scene.simulate_lidar(SENSOR, *args, **options)

    pose = [0, *MIDDLE, 0, 0, 0, 1]
    refused(ValueError, "no pose")
    refused(ValueError, "trajectory and pose", [pose], pose=MIDDLE)
    refused(ValueError, r"shape \[N, 8\]", MIDDLE)
    refused(ValueError, "x y z yaw pitch roll", pose=[1, 2])
    refused(ValueError, "pose 1: .*time", [pose, pose])
    refused(ValueError, "quaternion is 0", [[0, *MIDDLE, 0, 0, 0, 0]])
    refused(ValueError, "not finite", pose=[0, np.nan, 0])
    refused(ValueError, "duration_s", pose=MIDDLE, duration=0)
    refused(ValueError, "attribute 'gloss'", pose=MIDDLE, attributes=["gloss"])
    refused(pointrt.Error, "gone.csv: No such file", tmp_path / "gone.csv")
    with pytest.raises(pointrt.Error, match="gone.toml: No such file"):
        scene.simulate_lidar(tmp_path / "gone.toml")
    with pytest.raises(TypeError, match="not object"):
        scene.simulate_lidar({**SENSOR, "range": {"max_m": object()}}, pose=MIDDLE)


def test_ctrl_c_interrupts(scene):
    timer = threading.Timer(0.5, signal.raise_signal, [signal.SIGINT])
    timer.start()
    with pytest.raises(KeyboardInterrupt):  # months of pulses
        scene.simulate_lidar({**SENSOR, "detection": {"drop_probability": 1}}, pose=MIDDLE, duration=1e7)
    timer.join()
