#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Bad command lines, scans, .pro files, transforms, rays, scenes, sensors and lists of cameras: error lines and exit
# codes are the same on both systems.
#   POINTRT_WINDOWS_BAD_INPUTS: how many (default 45)
# shellcheck source=lib.sh
. "$(dirname "$0")/lib.sh"
needsDisplay
needs pointrt-bake
needs pointrt-rays
needs pointrt-view

sphere 200 >sphere.xyz
"$bin/pointrt-bake" -q sphere.xyz -o sphere.pro
for suffix in ply pcd las; do "$bin/pointrt-info" sphere.pro --export sphere.$suffix; done
printf '%s\n' '1 0 0 10' '0 1 0 20' '0 0 1 30' '0 0 0 1' >transform.txt
writeScene
writeCameras
cp "$repository/docs/sensors/street.toml" sensor.toml
printf '%s\n' '0 0 5 0.01 0.02 -1' '0.1 0.2 5 0 0 -1' '1,2,5,0,0.5,-1' >rays.txt
python3 - <<'END'
header = b"{'descr': '<f4', 'fortran_order': False, 'shape': (2, 6), }"
header += b" " * (117 - len(header)) + b"\n"  # 128 bytes with the 10 before it
with open("rays.npy", "wb") as file:
    file.write(b"\x93NUMPY\x01\x00" + len(header).to_bytes(2, "little") + header + bytes(2 * 6 * 4))
END
mkdir folder
python3 "$repository/tests/windows/bad_input.py" "$bin" "$build" "${POINTRT_WINDOWS_BAD_INPUTS:-45}"
