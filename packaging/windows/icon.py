#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Makes pointrt.ico, the programs' icon in Windows, of packaging/desktop/pointrt.svg by rsvg-convert (librsvg2-bin).
   packaging/windows/icon.py   writes beside itself; to be run when the drawing changes
"""
import pathlib
import struct
import subprocess

HERE = pathlib.Path(__file__).parent
SIZES = (16, 24, 32, 48, 64, 256)  # what the title bar, the task bar and the Explorer show at 100% to 200%


def picture(size):
    drawing = HERE.parent / "desktop" / "pointrt.svg"
    command = ["rsvg-convert", "--width", str(size), "--height", str(size), str(drawing)]
    return subprocess.run(command, check=True, stdout=subprocess.PIPE).stdout


def icon(pictures):
    """The bytes of an icon: a header, an entry of 16 bytes for each (size, PNG file) of pictures, and the PNG files."""
    header = struct.pack("<HHH", 0, 1, len(pictures))  # reserved, 1 for an icon, how many
    entries, offset = b"", len(header) + 16 * len(pictures)
    for size, png in pictures:
        side = size % 256  # 0 is 256
        entries += struct.pack("<BBBBHHII", side, side, 0, 0, 1, 32, len(png), offset)
        offset += len(png)
    return header + entries + b"".join(png for _, png in pictures)


(HERE / "pointrt.ico").write_bytes(icon([(size, picture(size)) for size in SIZES]))
