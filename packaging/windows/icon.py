#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Makes pointrt.ico, the programs' icon in Windows, from packaging/desktop/pointrt.svg with rsvg-convert (librsvg2-bin).
   packaging/windows/icon.py   writes next to itself; run it when the drawing changes
"""
import pathlib
import struct
import subprocess

HERE = pathlib.Path(__file__).parent
SIZES = (16, 24, 32, 48, 64, 256)  # the sizes shown in the title bar, task bar and Explorer at 100% to 200% scaling


def picture(size):
    drawing = HERE.parent / "desktop" / "pointrt.svg"
    command = ["rsvg-convert", "--width", str(size), "--height", str(size), str(drawing)]
    return subprocess.run(command, check=True, stdout=subprocess.PIPE).stdout


def icon(pictures):
    """The bytes of an icon: a header, an entry of 16 bytes for each (size, PNG file) of pictures, and the PNG files."""
    header = struct.pack("<HHH", 0, 1, len(pictures))  # reserved, 1 means icon, number of pictures
    entries, offset = b"", len(header) + 16 * len(pictures)
    for size, png in pictures:
        side = size % 256  # 0 means 256
        entries += struct.pack("<BBBBHHII", side, side, 0, 0, 1, 32, len(png), offset)
        offset += len(png)
    return header + entries + b"".join(png for _, png in pictures)


(HERE / "pointrt.ico").write_bytes(icon([(size, picture(size)) for size in SIZES]))
