# SPDX-License-Identifier: Apache-2.0
"""Smooth closed meshes with exact normals, and the one PLY layout that all renderers read here."""

import numpy as np

# Facets this fine leave a sphere of 150 pixels radius by a thousandth of a pixel.
SPHERE_LEVELS = 7
KNOT_RINGS, KNOT_SIDES = 1600, 128
KNOT_RING_RADIUS, KNOT_COIL_RADIUS, KNOT_TUBE_RADIUS = 0.68, 0.30, 0.15
RING_SIDES, RING_EDGE_SIDES = 2048, 16
RING_BOTTOM, RING_TOP, RING_EDGE_RADIUS = 0.05, 0.55, 0.05  # inside it has radius 1

# Waves on the blob: amplitude, wave vector, phase. Together under a third of its radius, so that it stays star-shaped.
BLOB_WAVES = (
    (0.09, (2.9, 1.1, -0.7), 0.4),
    (0.07, (-1.3, 3.4, 1.9), 1.9),
    (0.06, (1.7, -2.2, 3.6), 3.1),
)


def normalize(vectors):
    return vectors / np.linalg.norm(vectors, axis=-1, keepdims=True)


def icosahedron():
    golden = (1 + 5**0.5) / 2
    corners = np.array(
        [np.roll((0, one, phi), axis) for axis in range(3) for one in (-1, 1) for phi in (-golden, golden)]
    )
    corners = normalize(corners)
    faces = []
    for a in range(12):
        for b in range(a + 1, 12):
            for c in range(b + 1, 12):
                # Three corners make a face when each is next to the others, at a cosine of 1 / sqrt(5) = 0.447.
                if min(corners[a] @ corners[b], corners[b] @ corners[c], corners[c] @ corners[a]) < 0.44:
                    continue
                outward = corners[a] @ np.cross(corners[b], corners[c]) > 0
                faces.append((a, b, c) if outward else (a, c, b))
    return corners, np.array(faces)


def sphere(levels=SPHERE_LEVELS):
    """Unit sphere of 20 * 4^levels faces: positions (n, 3), normals (n, 3), faces (m, 3)."""
    points, faces = icosahedron()
    for _ in range(levels):
        edges = np.sort(np.concatenate([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]]), axis=1)
        edges, middle = np.unique(edges, axis=0, return_inverse=True)
        middle = middle.reshape(3, -1) + len(points)
        points = np.concatenate([points, normalize(points[edges[:, 0]] + points[edges[:, 1]])])
        a, b, c = faces.T
        ab, bc, ca = middle
        parts = [(a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca)]
        faces = np.concatenate([np.stack(part, axis=1) for part in parts])
    return points, points, faces


def blob():
    """A bumpy ball about the origin of radius 0.8 to 1.2, laid out as sphere()."""
    directions, _, faces = sphere()
    radius, slope = np.ones((len(directions), 1)), np.zeros_like(directions)
    for amplitude, wave, phase in BLOB_WAVES:
        angle = directions @ np.array(wave) + phase
        radius += amplitude * np.sin(angle)[:, None]
        slope += amplitude * np.cos(angle)[:, None] * np.array(wave)
    # Gradient of |p| - radius(p / |p|).
    along = np.sum(slope * directions, axis=1, keepdims=True)
    return directions * radius, normalize(directions - (slope - along * directions) / radius), faces


def knot():
    """A tube along the trefoil, wound on a torus about the z axis, laid out as sphere()."""
    t = np.linspace(0, 2 * np.pi, KNOT_RINGS, endpoint=False)
    around, coil = 2 * t, 3 * t
    outward = np.stack([np.cos(around), np.sin(around), 0 * t], axis=1)
    sideways = np.stack([-np.sin(around), np.cos(around), 0 * t], axis=1)
    up = np.array([0.0, 0.0, 1.0])
    distance = KNOT_RING_RADIUS + KNOT_COIL_RADIUS * np.cos(coil)[:, None]
    centre = distance * outward + KNOT_COIL_RADIUS * np.sin(coil)[:, None] * up
    tangent = normalize(
        2 * distance * sideways
        + 3 * KNOT_COIL_RADIUS * (np.cos(coil)[:, None] * up - np.sin(coil)[:, None] * outward)
    )
    # The torus' normal is square to every curve on it: a frame that closes.
    first = np.cos(coil)[:, None] * outward + np.sin(coil)[:, None] * up
    second = np.cross(tangent, first)
    side = 2 * np.pi * np.arange(KNOT_SIDES) / KNOT_SIDES
    normals = np.cos(side)[None, :, None] * first[:, None] + np.sin(side)[None, :, None] * second[:, None]
    return sweep(centre[:, None] + KNOT_TUBE_RADIUS * normals, normals)


def sweep(positions, normals):
    """Closed both ways: rows of points (rings, steps, 3) joined to those next to them, laid out as sphere()."""
    rings, steps, _ = positions.shape
    ring, step = np.meshgrid(np.arange(rings), np.arange(steps), indexing="ij")
    at = lambda i, j: (i % rings * steps + j % steps).ravel()
    a, b, c, d = at(ring, step), at(ring + 1, step), at(ring + 1, step + 1), at(ring, step + 1)
    faces = np.concatenate([np.stack([a, c, b], axis=1), np.stack([a, d, c], axis=1)])
    return positions.reshape(-1, 3), normals.reshape(-1, 3), faces


def ring():
    """An upright wall around the y axis with rounded edges, laid out as sphere()."""
    half = np.linspace(0, np.pi, RING_EDGE_SIDES + 1)
    side = np.concatenate([half, half + np.pi])  # 0: outwards; the jumps at 0 and pi are the upright stretches
    high = np.repeat([RING_TOP - RING_EDGE_RADIUS, RING_BOTTOM + RING_EDGE_RADIUS], len(half))
    turn = (2 * np.pi * np.arange(RING_SIDES) / RING_SIDES)[:, None]
    along = np.cos(side)
    distance = 1 + RING_EDGE_RADIUS * (1 + along)
    place = lambda away, up: np.stack([away * np.cos(turn), up + 0 * turn, away * np.sin(turn)], axis=2)
    return sweep(place(distance, high + RING_EDGE_RADIUS * np.sin(side)), place(along, np.sin(side)))


MAKERS = {"sphere": sphere, "blob": blob, "knot": knot, "ring": ring}


def area(positions, faces):
    a, b, c = (positions[faces[:, i]] for i in range(3))
    return np.linalg.norm(np.cross(b - a, c - a), axis=1).sum() / 2


VERTEX = np.dtype([("position", "<f4", 3), ("normal", "<f4", 3)])
FACE = np.dtype([("count", "u1"), ("corners", "<i4", 3)])
HEADER = """ply
format binary_little_endian 1.0
element vertex {}
property float x
property float y
property float z
property float nx
property float ny
property float nz
element face {}
property list uchar int vertex_indices
end_header
"""


def writePly(path, positions, normals, faces):
    vertices = np.empty(len(positions), VERTEX)
    vertices["position"], vertices["normal"] = positions, normals
    rows = np.empty(len(faces), FACE)
    rows["count"], rows["corners"] = 3, faces
    with open(path, "wb") as file:
        file.write(HEADER.format(len(vertices), len(rows)).encode())
        file.write(vertices.tobytes() + rows.tobytes())


def readPly(path):
    """Reads what writePly wrote, and nothing else."""
    with open(path, "rb") as file:
        content = file.read()
    start = content.index(b"end_header\n") + len(b"end_header\n")
    counts = [int(line.split()[2]) for line in content[:start].splitlines() if line.startswith(b"element")]
    vertices = np.frombuffer(content, VERTEX, counts[0], start)
    rows = np.frombuffer(content, FACE, counts[1], start + vertices.nbytes)
    return vertices["position"], vertices["normal"], rows["corners"]
