# SPDX-License-Identifier: Apache-2.0
"""Reads scans with other readers, with results like those of read_scan."""
import os

import numpy as np

import other_kinds
from results import in_own_process, with_extents

# laspy's dimensions that are not attributes in our reader: positions and colours
LAS_ROLES = {"X", "Y", "Z", "red", "green", "blue"}
# not read here
LAS_WAVEFORM = {"wavepacket_index", "wavepacket_offset", "wavepacket_size", "return_point_wave_location", "x_t", "y_t",
                "z_t"}


def read_las(path):
    import laspy
    las = laspy.read(path)
    attributes = {name: np.asarray(las[name]) for name in las.point_format.dimension_names if name not in LAS_ROLES}
    if "red" in las.point_format.dimension_names:
        attributes["rgb16"] = np.stack([np.asarray(las[name]) for name in ("red", "green", "blue")], axis=1)
    positions = np.stack([np.asarray(las.x), np.asarray(las.y), np.asarray(las.z)], axis=1)
    return with_extents("laspy", positions, attributes)


E57_NAMES = {"intensity": "intensity", "rowIndex": "row", "columnIndex": "column", "returnIndex": "return_number",
             "returnCount": "number_of_returns", "timeStamp": "time_stamp"}


def e57_positions(raw):
    """Positions in the scan's frame; NaN where neither kind of coordinates is valid."""
    count = len(next(iter(raw.values())))
    positions = np.full((count, 3), np.nan)
    if "sphericalRange" in raw:
        distance, azimuth, elevation = (raw["spherical" + each] for each in ("Range", "Azimuth", "Elevation"))
        flat = distance * np.cos(elevation)
        positions = np.stack([flat * np.cos(azimuth), flat * np.sin(azimuth), distance * np.sin(elevation)], axis=1)
        if "sphericalInvalidState" in raw:
            positions[raw["sphericalInvalidState"] != 0] = np.nan
    if "cartesianX" in raw:
        valid = raw["cartesianInvalidState"] == 0 if "cartesianInvalidState" in raw else np.ones(count, bool)
        positions[valid] = np.stack([raw["cartesian" + axis] for axis in "XYZ"], axis=1)[valid]
    return positions


def e57_columns(file, scan):
    """All columns of a scan as doubles: pye57's read_scan_raw omits some, and reads colours as bytes."""
    from pye57 import libe57
    points = file.get_header(scan).points
    prototype = libe57.StructureNode(points.prototype())
    names = [prototype.get(i).elementName() for i in range(prototype.childCount())]
    arrays, buffers = {}, libe57.VectorSourceDestBuffer()
    for name in names:
        arrays[name] = np.empty(points.childCount(), np.float64)
        buffers.append(libe57.SourceDestBuffer(file.image_file, name, arrays[name], len(arrays[name]), True, True))
    points.reader(buffers).read()
    return arrays


def e57_world(file, scan, raw):
    """A scan's positions in the file's frame."""
    header, local = file.get_header(scan), e57_positions(raw)
    return local @ header.rotation_matrix.T + header.translation if header.has_pose() else local


def read_e57(path):
    import pye57
    file = pye57.E57(path)
    positions, attributes = [np.empty((0, 3))], {}
    for scan in range(file.scan_count):
        if file.get_header(scan).point_count == 0:
            continue
        raw = e57_columns(file, scan)
        positions.append(e57_world(file, scan, raw))
        for name, attribute in E57_NAMES.items():
            if name in raw:
                # files count returns from 0, or from 1 if one is as large as their number; we count from 1
                counts = raw.get("returnCount", np.full(1, np.inf))
                from_0 = name == "returnIndex" and not ((counts > 0) & (raw[name] >= counts)).any()
                attributes.setdefault(attribute, []).append(raw[name] + from_0)
    positions = np.concatenate(positions)
    whole = {name: np.concatenate(parts) for name, parts in attributes.items()}
    # columns that only some scans have are 0 or NaN in the others
    return with_extents("pye57", positions, {name: array for name, array in whole.items()
                                             if len(array) == len(positions)})


# and texture coordinates, which are not read
PLY_ROLES = {"x", "y", "z", "nx", "ny", "nz", "red", "green", "blue", "diffuse_red", "diffuse_green", "diffuse_blue",
             "s", "t", "u", "v", "texture_u", "texture_v"}


def ply_name(name, known):
    """The name that our PLY reader gives it: without CloudCompare's prefix."""
    return name[len("scalar_"):].lower() if name.lower().startswith("scalar_") and \
        name[len("scalar_"):].lower() in known else name


KNOWN_NAMES = {"intensity", "classification", "return_number", "number_of_returns", "gps_time", "user_data",
               "point_source_id", "scan_angle_rank", "scan_angle", "nir"}


def read_ply(path):
    from plyfile import PlyData
    vertex = PlyData.read(path, mmap=False)["vertex"]
    names = [each.name for each in vertex.properties]
    positions = np.stack([np.asarray(vertex[axis], np.float64) for axis in "xyz"], axis=1)
    gaussians = "f_dc_0" in names
    attributes = {} if gaussians else {
        ply_name(name, KNOWN_NAMES): np.asarray(vertex[name]) for name in names
        if name not in PLY_ROLES and np.asarray(vertex[name]).dtype != object}
    theirs = with_extents("plyfile", positions, attributes)
    theirs["gaussians"] = gaussians
    theirs["zero_normals"] = "nx" in names and not any(np.any(np.asarray(vertex[name])) for name in ("nx", "ny", "nz"))
    return theirs


def read_any_ply(path):
    """plyfile rejects the headers of Cyberware's scans and does not support packed Gaussians."""
    if path.endswith(".compressed.ply"):
        return other_kinds.read_gaussians(path)
    with open(path, "rb") as file:
        cyberware = b"is_cyberware_data" in file.read(256)
    return other_kinds.read_mesh(path) if cyberware else read_ply(path)


def pcd_in_this_process(path):
    import open3d
    points = open3d.t.io.read_point_cloud(path).point
    names = {"intensity", "curvature", "label", "ring"} & set(points)  # as they are; colours and normals are renamed
    if "positions" not in points:
        raise ValueError("no points")
    positions = points["positions"].numpy()
    theirs = with_extents("open3d", positions.astype(np.float64), {name: points[name].numpy() for name in names})
    # text becomes floats if the header says so, where our reader keeps the precision of the text
    theirs["relative_step"] = float(np.finfo(positions.dtype).eps)
    return theirs


def read_pcd(path):
    """Some files crash the process."""
    return in_own_process(pcd_in_this_process, path)


READERS = {".pcd": read_pcd, ".las": read_las, ".laz": read_las, ".e57": read_e57, ".ply": read_any_ply,
           ".obj": other_kinds.read_mesh, ".off": other_kinds.read_mesh, ".stl": other_kinds.read_mesh,
           ".glb": other_kinds.read_mesh, ".gltf": other_kinds.read_mesh, ".drc": other_kinds.read_draco,
           ".asc": other_kinds.read_grid, ".ptx": other_kinds.read_ptx, ".splat": other_kinds.read_splat,
           ".spz": other_kinds.read_spz, ".sog": other_kinds.read_gaussians,
           ".xyz": other_kinds.read_table, ".txt": other_kinds.read_table, ".csv": other_kinds.read_table,
           ".pts": other_kinds.read_table}


def reader_of(path):
    return other_kinds.read_gaussians if path.endswith("_sog/meta.json") else \
        READERS.get(os.path.splitext(path)[1].lower())


def read(path):
    """A dictionary, or None and the reason."""
    reader = reader_of(path)
    if reader is None:
        return None, None
    try:
        return reader(path), None
    except Exception as error:  # any failure of theirs counts
        return None, "%s: %s" % (type(error).__name__, str(error).split("\n")[0][:100])
