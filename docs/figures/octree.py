#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Draws a slice through the octree of a .pro file as SVG: octree.py FILE.pro OUT.svg [DEPTH [X0,X1,Y0,Y1]]

DEPTH: depth of the slice in the cube along z, 0 to 1. X0,X1,Y0,Y1: the part of the cube to draw.
Reads the file according to format/SPEC.md in pure Python, so it is also an example of how to read one.
"""
import struct
import sys

HEADER_SECTION_COUNT, TABLE, RECORD = 32, 512, 64  # all sizes in bytes
RADIUS_MAX, RADIUS_STEP = 68, 72
INNER, SLOTS = 1 << 31, 8


def sections(data):
    """Each section's bytes by its kind."""
    (count,) = struct.unpack_from("<I", data, HEADER_SECTION_COUNT)
    found = {}
    for number in range(count):
        kind, _, _, offset, length = struct.unpack_from("<4sIQQQ", data, TABLE + RECORD * number)
        found[kind.decode()] = data[offset : offset + length]
    return found


def words(section):
    return struct.unpack(f"<{len(section) // 4}I", section)


def decodeNormal(u, v):
    a, b = 2 * u / 4095 - 1, 2 * v / 4095 - 1
    c = 1 - abs(a) - abs(b)
    fold = max(-c, 0)
    a, b = a - (fold if a >= 0 else -fold), b - (fold if b >= 0 else -fold)
    length = (a * a + b * b + c * c) ** 0.5
    return a / length, b / length, c / length


def decodeSplat(row, radius_max, radius_step):
    """Position and normal in the cube, radius."""
    x, y, z = row[0] & 0x1FFFFF, row[0] >> 21 | (row[1] & 0x3FF) << 11, row[1] >> 10 & 0x1FFFFF
    position = tuple((code + 0.5) / 2**21 for code in (x, y, z))
    radius = radius_max * 2 ** (-(row[3] >> 24) * radius_step)
    return position, decodeNormal(row[2] & 0xFFF, row[2] >> 12 & 0xFFF), radius


def cutLeaves(nodes, z):
    """The leaves that the slice cuts: corner, edge, and the leaf's number (None if it is empty)."""
    leaves, left = [], [(0, (0.0, 0.0, 0.0), 1.0)]
    while left:
        node, low, edge = left.pop()
        if not low[2] <= z < low[2] + edge:
            continue
        word = nodes[node]
        if not word & INNER:
            leaves.append((low, edge, word - 1 if word else None))
            continue
        half = edge / 2
        for slot in range(SLOTS):
            corner = tuple(low[axis] + (slot >> axis & 1) * half for axis in range(3))
            left.append(((word & ~INNER) * SLOTS + slot, corner, half))
    return leaves


def chord(splat, z):
    """Both ends, in x and y, of the line along which the slice cuts a disc; None if it does not."""
    (x, y, height), (nx, ny, nz), radius = splat
    across = (nx * nx + ny * ny) ** 0.5
    if across < 1e-6:
        return None
    distance = (z - height) / across  # in the disc's plane, from its centre to the line
    if abs(distance) >= radius:
        return None
    # the steepest direction of the disc's plane is (-nx nz, -ny nz, across^2) / across
    middle = x - nx * nz / across * distance, y - ny * nz / across * distance
    half = (radius * radius - distance * distance) ** 0.5 / across
    return tuple((middle[0] + sign * half * -ny, middle[1] + sign * half * nx) for sign in (-1, 1))


COLOURS = {"empty": "#f6f7f9", "border": "#f7e3b5", "filled": "#bcd9f2"}


def draw(data, z, window):
    """The SVG's text."""
    part = sections(data)
    radius_max, radius_step = struct.unpack_from("<ff", data, RADIUS_MAX)
    leaf_rows, splat_words = words(part["LEAF"]), words(part["SPLT"])
    references = words(part["REFS"])
    x0, x1, y0, y1 = window
    size = 800 / (x1 - x0)
    at = lambda x, y: ((x - x0) * size, (y1 - y) * size)  # noqa: E731: y is up in the cube, down in SVG
    cells, shown = [], set()
    for low, edge, leaf in cutLeaves(words(part["NODE"]), z):
        if low[0] > x1 or low[0] + edge < x0 or low[1] > y1 or low[1] + edge < y0:
            continue
        kind = "empty"
        if leaf is not None:
            first, first_ref, counts, _ = leaf_rows[4 * leaf : 4 * leaf + 4]
            members, refs = counts & 0xFFFF, counts >> 16
            kind = "filled" if members else "border"
            shown.update(range(first, first + members), references[first_ref : first_ref + refs])
        left, top = at(low[0], low[1] + edge)
        cells.append(f'<rect x="{left:.1f}" y="{top:.1f}" width="{edge * size:.1f}" height="{edge * size:.1f}" '
                     f'fill="{COLOURS[kind]}"/>')
    lines = []
    for splat in sorted(shown):
        ends = chord(decodeSplat(splat_words[4 * splat : 4 * splat + 4], radius_max, radius_step), z)
        if ends:
            (ax, ay), (bx, by) = at(*ends[0]), at(*ends[1])
            lines.append(f"M{ax:.1f} {ay:.1f}L{bx:.1f} {by:.1f}")
    height = (y1 - y0) * size
    return (f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 800 {height:.0f}" width="560">'
            f'<g stroke="#8c99a8" stroke-width="0.6">{"".join(cells)}</g>'
            f'<path d="{"".join(lines)}" fill="none" stroke="#b3261e" stroke-width="1.6"/></svg>\n')


def main():
    if not 3 <= len(sys.argv) <= 5:
        sys.exit(__doc__.splitlines()[0])
    z = float(sys.argv[3]) if len(sys.argv) > 3 else 0.5
    window = tuple(map(float, sys.argv[4].split(","))) if len(sys.argv) > 4 else (0.0, 1.0, 0.0, 1.0)
    with open(sys.argv[1], "rb") as file:
        picture = draw(file.read(), z, window)
    with open(sys.argv[2], "w", encoding="ascii") as file:
        file.write(picture)


if __name__ == "__main__":
    main()
