# SPDX-License-Identifier: Apache-2.0
"""Memory of closed scenes, interruption, and missing devices."""
import os
import pathlib
import signal
import subprocess
import sys
import time

import numpy as np
import pytest

import pointrt

DOWN = [10.0, 10.0, 50.0, 0.0, 0.0, -1.0]


def resident_bytes():
    return int(pathlib.Path("/proc/self/statm").read_text().split()[1]) * os.sysconf("SC_PAGE_SIZE")


def open_files():
    return len(os.listdir("/proc/self/fd"))


def open_and_close(path, times):
    for _ in range(times):
        pointrt.Scene(path).cast_rays([DOWN], fields=("t_hit",))


@pytest.mark.skipif(sys.platform != "linux", reason="reads /proc")
def test_closed_scenes_free_their_memory(field):
    """A thousand scenes grew by less than 1 MB (tests/bench/RESULTS.md); this test opens fewer, for a few seconds."""
    open_and_close(field, 40)  # fills pools and caches of programs
    memory, files = resident_bytes(), open_files()
    open_and_close(field, 120)
    grown = resident_bytes() - memory
    assert open_files() == files
    scene_bytes = os.path.getsize(field)
    assert grown < 8 * scene_bytes, f"120 scenes of {scene_bytes} bytes left {grown}"


#: Casts for minutes, unless it is stopped.
_LONG = """
import sys, numpy as np, pointrt
scene = pointrt.Scene(sys.argv[1])
rays = np.tile([500010.0, 4500010.0, 150.0, 0.0, 0.0, -1.0], (1 << 20, 1))
try:
    print("casting", flush=True)
    while True:
        scene.cast_rays(rays)
except KeyboardInterrupt:
    print("stopped", len(scene.cast_rays(rays[:1])["t_hit"]), flush=True)
"""


@pytest.mark.skipif(sys.platform == "win32", reason="Windows sends Ctrl-C to consoles, not to one process")
def test_control_c_stops_a_cast_and_leaves_the_scene_usable(field):
    child = subprocess.Popen([sys.executable, "-c", _LONG, field], stdout=subprocess.PIPE, text=True)
    assert child.stdout.readline() == "casting\n"
    time.sleep(0.3)
    child.send_signal(signal.SIGINT)
    said, _ = child.communicate(timeout=60)
    assert (said, child.returncode) == ("stopped 1\n", 0)


def test_no_device_is_an_exception(field):
    code = "import sys, pointrt\ntry:\n pointrt.Scene(sys.argv[1])\nexcept pointrt.Error as error:\n print(error)"
    nowhere = {**os.environ, "VK_ICD_FILENAMES": "/nonexistent.json", "VK_DRIVER_FILES": "/nonexistent.json"}
    done = subprocess.run([sys.executable, "-c", code, field], env=nowhere, capture_output=True, text=True, check=True)
    assert done.stdout.count("\n") == 1 and "no Vulkan driver" in done.stdout, done.stdout + done.stderr
