#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Bakes each input with pointrt-bake of this system and, in Wine, with that for Windows: exit code, messages and output
files must be the same.
   bake_inputs.py BIN BUILD INPUT...   BIN, BUILD: see lib.sh; writes to the current folder
"""
import pathlib
import subprocess
import sys

BIN, BUILD = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2])
OUTPUT = pathlib.Path("baked.pro")
# Whether Rust is missing for Windows alone, so that its tools refuse LAZ and E57 (cmake/Rust.cmake).
LACKS_RUST = "Without LAZ and E57" in (BUILD / "log").read_text()


def answer(program, scan):
    """Exit code, words and the bytes written. A bake that takes minutes is taken for one that hangs."""
    OUTPUT.unlink(missing_ok=True)
    result = subprocess.run([*program, "-q", scan, "-o", OUTPUT], stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                            stderr=subprocess.PIPE, timeout=600, check=False)
    # Windows joins paths with \
    words = (result.stdout + result.stderr).replace(b"\\", b"/").decode(errors="replace")
    return result.returncode, words, OUTPUT.read_bytes() if OUTPUT.exists() else None


def difference(here, there):
    if here[:2] != there[:2]:
        return f"\n  here:    {here[:2]}\n  Windows: {there[:2]}"
    if here[2] is None or there[2] is None or len(here[2]) != len(there[2]):
        return f"another size: {[len(each[2] or b'') for each in (here, there)]}"
    return f"{sum(a != b for a, b in zip(here[2], there[2]))} bytes differ"


def isRefusedForRust(there):
    return LACKS_RUST and there[0] == 3 and "install Rust" in there[1]


def main():
    baked, refused, differing = 0, 0, []
    for scan in sys.argv[3:]:
        here = answer([BIN / "pointrt-bake"], scan)
        there = answer(["wine", BUILD / "bin/pointrt-bake.exe"], scan)
        baked += here[0] == 0
        if isRefusedForRust(there):
            refused += 1
        elif here != there:
            differing.append(f"{scan}: {difference(here, there)}")
    print("\n".join(differing))
    print(f"{len(sys.argv) - 3} inputs, {baked} baked, {len(differing)} otherwise in Windows, "
          f"{refused} not compared without Rust")
    sys.exit(bool(differing) or baked == 0)


main()
