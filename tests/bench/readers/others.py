# SPDX-License-Identifier: Apache-2.0
"""What readers that are not ours make of a scan, in the terms of read_scan."""
import os

import numpy as np

# laspy's dimensions that are no attributes of ours: positions, colours apart, and what it makes up itself
LAS_ROLES = {"X", "Y", "Z", "red", "green", "blue"}


def summary(array):
    """Of the numbers that are finite."""
    array = np.asarray(array).reshape(-1)
    finite = array[np.isfinite(array)].astype(np.float64) if array.dtype.kind == "f" else array.astype(np.float64)
    if len(finite) == 0:
        return {"size": 0.0}
    return {"min": float(finite.min()), "max": float(finite.max()), "sum": float(finite.sum()),
            "size": float(np.abs(finite).sum())}


def with_extents(reader, positions, step, attributes):
    """positions: three columns of doubles, of which only whole finite rows count."""
    good = np.isfinite(positions).all(axis=1)
    positions = positions[good]
    extents = [(float(column.min()), float(column.max())) for column in positions.T] if len(positions) else []
    return {"reader": reader, "points": int(good.sum()), "extents": extents, "step": step,
            "attributes": {name: summary(array[good]) for name, array in attributes.items()}}


def read_las(path):
    import laspy
    las = laspy.read(path)
    attributes = {name: np.asarray(las[name]) for name in las.point_format.dimension_names if name not in LAS_ROLES}
    if "red" in las.point_format.dimension_names:
        attributes["rgb16"] = np.stack([np.asarray(las[name]) for name in ("red", "green", "blue")], axis=1)
    positions = np.stack([np.asarray(las.x), np.asarray(las.y), np.asarray(las.z)], axis=1)
    return with_extents("laspy", positions, 0, attributes)


E57_NAMES = {"intensity": "intensity", "rowIndex": "row", "columnIndex": "column", "returnIndex": "return_number",
             "returnCount": "number_of_returns", "timeStamp": "time_stamp"}


def e57_positions(raw):
    """In the scan's frame; NaN where neither kind of coordinates is valid."""
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


def read_e57(path):
    import pye57
    file = pye57.E57(path)
    positions, attributes = [np.empty((0, 3))], {}
    for scan in range(file.scan_count):
        header = file.get_header(scan)
        if header.point_count == 0:
            continue
        raw = file.read_scan_raw(scan, ignore_unsupported_fields=True)
        local = e57_positions(raw)
        if header.has_pose():
            local = local @ header.rotation_matrix.T + header.translation
        positions.append(local)
        for name, attribute in E57_NAMES.items():
            if name in raw:
                attributes.setdefault(attribute, []).append(raw[name] + (name == "returnIndex"))
    whole = {name: np.concatenate(parts) for name, parts in attributes.items()}
    positions = np.concatenate(positions)
    return with_extents("pye57", positions, 0, {name: array for name, array in whole.items() if len(array) == len(positions)})


PLY_ROLES = {"x", "y", "z", "nx", "ny", "nz", "red", "green", "blue", "diffuse_red", "diffuse_green", "diffuse_blue"}


def ply_name(name, known):
    """As the reader of PLY names it: CloudCompare's prefix goes."""
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
    theirs = with_extents("plyfile", positions, 0, attributes)
    if gaussians:
        theirs["points"] = None  # those that are nearly transparent are left out
    return theirs


READERS = {".las": read_las, ".laz": read_las, ".e57": read_e57, ".ply": read_ply}


def read(path):
    """A dictionary, or None and why not."""
    reader = READERS.get(os.path.splitext(path)[1].lower())
    if reader is None:
        return None, None
    try:
        return reader(path), None
    except Exception as error:  # whatever it is, it is theirs
        return None, "%s: %s" % (type(error).__name__, str(error).split("\n")[0][:100])
