#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes a cloud with other programs' libraries in the formats that they own, and compares what read_scan makes of it.

  exchange.py BIN_DIR [--points N]

Prints a row for each file: right, or what disagrees. Exits with 1 if anything does. Positions, colours, normals,
intensities, rings and faces are compared by their number, extremes and sums.
Needs numpy, tifffile, imagecodecs, trimesh, rosbags, mcap, vtk and DracoPy (PyPI).
"""
import argparse
import json
import os
import struct
import subprocess
import sys
import tempfile

import numpy as np


class Cloud:
    def __init__(self, points):
        random = np.random.default_rng(5)
        self.count = points
        self.xyz = random.random((points, 3)) * [4, 3, 2] + [10, 20, 30]
        self.rgb = (random.random((points, 3)) * 255).astype(np.uint8)
        self.intensity = random.random(points).astype(np.float32)
        self.ring = (np.arange(points) % 32).astype(np.uint16)
        normals = random.normal(size=(points, 3))
        self.normals = (normals / np.linalg.norm(normals, axis=1)[:, None]).astype(np.float32)


class Files:
    """The files, and what must be read from each."""

    def __init__(self, folder):
        self.folder, self.expected = folder, {}

    def path(self, name, **expected):
        path = os.path.join(self.folder, name)
        os.makedirs(os.path.dirname(path), exist_ok=True)
        self.expected[path] = expected
        return path

    def write(self, name, data, **expected):
        with open(self.path(name, **expected), "wb") as file:
            file.write(data)


def write_numpy(cloud, files):
    np.save(files.path("rows.npy"), cloud.xyz)
    np.save(files.path("big_endian.npy"), cloud.xyz.astype(">f8"))
    np.save(files.path("fortran.npy"), np.asfortranarray(cloud.xyz))
    np.save(files.path("transposed.npy"), np.ascontiguousarray(cloud.xyz.T))
    np.save(files.path("kitti.npy", intensity=True), np.c_[cloud.xyz, cloud.intensity].astype(np.float32))
    np.save(files.path("colours.npy", rgb=0), np.c_[cloud.xyz, cloud.rgb].astype(np.float64))
    np.save(files.path("normals.npy", normals=True), np.c_[cloud.xyz, cloud.normals].astype(np.float32))
    records = np.zeros(cloud.count, np.dtype([("x", "<f4"), ("y", "<f4"), ("z", "<f4"), ("intensity", "<f4"),
                                              ("ring", "<u2"), ("rgb", "u1", (3,))], align=True))
    records["x"], records["y"], records["z"] = cloud.xyz.T
    records["intensity"], records["ring"], records["rgb"] = cloud.intensity, cloud.ring, cloud.rgb
    np.save(files.path("records.npy", rgb=0, intensity=True, ring=True), records)
    np.savez_compressed(files.path("arrays.npz", rgb=0, normals=True, intensity=True), xyz=cloud.xyz, colors=cloud.rgb,
                        normals=cloud.normals, intensity=cloud.intensity, other=np.arange(7))


def write_tiff(_, files):
    import tifffile
    heights = (np.random.default_rng(6).random((30, 50)) * 100 + 1).astype(np.float32)
    heights[3, 4] = -9999
    tags = [(33550, "d", 3, (2.0, 2.0, 0.0), True), (33922, "d", 6, (0, 0, 0, 500000.0, 4000000.0, 0), True),
            (34735, "H", 16, (1, 1, 0, 3, 1024, 0, 1, 1, 1025, 0, 1, 1, 3072, 0, 1, 32633), True),
            (42113, "s", 0, "-9999", True)]
    kinds = {"strips": (np.float32, {}), "tiles_zstd": (np.float32, {"tile": (16, 16), "compression": "zstd"}),
             "lzw": (np.int16, {"compression": "lzw"}), "double": (np.float64, {"compression": "zlib"}),
             "predictor": (np.float32, {"compression": "zlib", "predictor": 3}), "big": (np.float32, {"bigtiff": True}),
             "big_endian": (np.float32, {"byteorder": ">"})}
    for name, (kind, options) in kinds.items():
        own = heights.astype(kind)
        height = own[own != -9999].astype(np.float64)
        path = files.path(name + ".tif", points=1499, z=(height.min(), height.max(), height.sum()))
        tifffile.imwrite(path, own, extratags=tags, metadata=None, **options)


def write_stl(_, files):
    import trimesh
    mesh = trimesh.creation.icosphere(subdivisions=1)
    mesh.export(files.path("binary.stl", points=len(mesh.vertices), faces=len(mesh.faces)))
    text = trimesh.exchange.stl.export_stl_ascii(mesh).encode()
    files.write("text.stl", text, points=len(mesh.vertices), faces=len(mesh.faces))


def point_cloud2(cloud, types, header):
    field, message = (types["sensor_msgs/msg/" + name] for name in ("PointField", "PointCloud2"))
    records = np.zeros(cloud.count, np.dtype({"names": ["x", "y", "z", "intensity", "ring"],
                                              "formats": ["<f4", "<f4", "<f4", "<f4", "<u2"],
                                              "offsets": [0, 4, 8, 16, 20], "itemsize": 24}))
    records["x"], records["y"], records["z"] = cloud.xyz.T
    records["intensity"], records["ring"] = cloud.intensity, cloud.ring
    fields = [field("x", 0, 7, 1), field("y", 4, 7, 1), field("z", 8, 7, 1), field("intensity", 16, 7, 1),
              field("ring", 20, 4, 1)]
    data = np.frombuffer(records.tobytes(), np.uint8)
    return message(header, 1, cloud.count, fields, False, 24, 24 * cloud.count, data, True)


SHIFT = 5.0  # of moved clouds along x: halfway between the poses


def transforms(types, header, vector, quaternion):
    """tf's message: the scanner moves from 0 to twice the shift in 2 s, around the clouds' time."""
    transform, message, stamped = (types[name] for name in (
        "geometry_msgs/msg/Transform", "tf2_msgs/msg/TFMessage", "geometry_msgs/msg/TransformStamped"))
    return [message([stamped(header(seconds, "odom"), "velodyne", transform(vector(x, 0.0, 0.0), quaternion))])
            for seconds, x in ((0, 0.0), (2, 2 * SHIFT))]


def of_ros1(types):
    def header(seconds, frame):
        return types["std_msgs/msg/Header"](0, types["builtin_interfaces/msg/Time"](seconds, 2), frame)

    return header, types["geometry_msgs/msg/Vector3"], types["geometry_msgs/msg/Quaternion"](0.0, 0.0, 0.0, 1.0)


def write_moving_bag(cloud, files):
    from rosbags.rosbag1 import Writer
    from rosbags.typesys import Stores, get_types_from_msg, get_typestore
    store = get_typestore(Stores.ROS1_NOETIC)
    if "tf2_msgs/msg/TFMessage" not in store.types:
        store.register(get_types_from_msg("geometry_msgs/TransformStamped[] transforms", "tf2_msgs/msg/TFMessage"))
    header, vector, quaternion = of_ros1(store.types)
    message = point_cloud2(cloud, store.types, header(1, "velodyne"))
    with Writer(files.path("poses.bag", times=2, intensity=True, ring=True, shift=SHIFT)) as writer:
        points = writer.add_connection("/velodyne_points", "sensor_msgs/msg/PointCloud2", typestore=store)
        tf = writer.add_connection("/tf", "tf2_msgs/msg/TFMessage", typestore=store)
        for stamp in (0, 10):
            writer.write(points, stamp, store.serialize_ros1(message, "sensor_msgs/msg/PointCloud2"))
        for pose in transforms(store.types, header, vector, quaternion):
            writer.write(tf, 20, store.serialize_ros1(pose, "tf2_msgs/msg/TFMessage"))


def write_bags(cloud, files):
    from rosbags.rosbag1 import Writer
    from rosbags.typesys import Stores, get_typestore
    store = get_typestore(Stores.ROS1_NOETIC)
    time = store.types["builtin_interfaces/msg/Time"](1, 2)
    message = point_cloud2(cloud, store.types, store.types["std_msgs/msg/Header"](0, time, "velodyne"))
    for name, compression in (("none", None), ("lz4", Writer.CompressionFormat.LZ4),
                              ("bz2", Writer.CompressionFormat.BZ2)):
        writer = Writer(files.path(name + ".bag", times=2, intensity=True, ring=True))
        if compression:
            writer.set_compression(compression)
        with writer:
            topic = writer.add_connection("/velodyne_points", "sensor_msgs/msg/PointCloud2", typestore=store)
            for stamp in (0, 10):
                writer.write(topic, stamp, store.serialize_ros1(message, "sensor_msgs/msg/PointCloud2"))


def write_mcaps(cloud, files):
    from mcap.writer import CompressionType, Writer
    from rosbags.typesys import Stores, get_typestore
    store = get_typestore(Stores.ROS2_HUMBLE)
    time = store.types["builtin_interfaces/msg/Time"](1, 2)
    message = point_cloud2(cloud, store.types, store.types["std_msgs/msg/Header"](time, "velodyne"))
    data = bytes(store.serialize_cdr(message, "sensor_msgs/msg/PointCloud2"))
    for name in ("NONE", "LZ4", "ZSTD"):
        with open(files.path(name.lower() + ".mcap", times=2, intensity=True, ring=True), "wb") as file:
            writer = Writer(file, compression=getattr(CompressionType, name))
            writer.start("ros2", "exchange")
            schema = writer.register_schema("sensor_msgs/msg/PointCloud2", "ros2msg", b"")
            channel = writer.register_channel("/points", "cdr", schema)
            for stamp in (0, 10):
                writer.add_message(channel, stamp, data, stamp)
            writer.finish()


def vtk_points(cloud):
    import vtk
    from vtk.util.numpy_support import numpy_to_vtk
    data, points = vtk.vtkPolyData(), vtk.vtkPoints()
    points.SetData(numpy_to_vtk(cloud.xyz.copy(), deep=1))
    data.SetPoints(points)
    for name, values in (("RGB", cloud.rgb), ("Normals", cloud.normals), ("intensity", cloud.intensity)):
        array = numpy_to_vtk(values.copy(), deep=1)
        array.SetName(name)
        {"RGB": data.GetPointData().SetScalars, "Normals": data.GetPointData().SetNormals}.get(
            name, data.GetPointData().AddArray)(array)
    return data


def write_vtk(cloud, files):
    import vtk
    sphere = vtk.vtkSphereSource()
    sphere.Update()
    mesh = sphere.GetOutput()
    of_mesh = {"points": mesh.GetNumberOfPoints(), "faces": mesh.GetNumberOfPolys()}
    of_points = {"rgb": 0, "normals": True, "intensity": True}
    for kind, data, expected in (("points", vtk_points(cloud), of_points), ("mesh", mesh, of_mesh)):
        for name, binary, version in (("text", False, 51), ("binary", True, 51), ("old", True, 42)):
            writer = vtk.vtkPolyDataWriter()
            writer.SetFileName(files.path(f"{kind}_{name}.vtk", **expected, tolerance=1e-4))
            writer.SetFileVersion(version)
            writer.SetInputData(data)
            (writer.SetFileTypeToBinary if binary else writer.SetFileTypeToASCII)()
            writer.Write()
        for name, mode, compressor, base64 in (("text", 0, "None", 0), ("base64", 1, "None", 0), ("zlib", 1, "ZLib", 0),
                                               ("raw", 2, "None", 0), ("raw_zlib", 2, "ZLib", 0),
                                               ("appended_zlib", 2, "ZLib", 1), ("raw_lz4", 2, "LZ4", 0)):
            writer = vtk.vtkXMLPolyDataWriter()
            writer.SetFileName(files.path(f"{kind}_{name}.vtp", **expected))
            writer.SetInputData(data)
            writer.SetDataMode(mode)
            writer.SetEncodeAppendedData(base64)
            getattr(writer, "SetCompressorTypeTo" + compressor)()
            writer.Write()


def pnts(features, data):
    text = json.dumps(features).encode()
    text += b" " * (-len(text) % 8)
    return struct.pack("<4s6I", b"pnts", 1, 28 + len(text) + len(data), len(text), len(data), 0, 0) + text + data


def write_pnts(cloud, files):
    import DracoPy
    centre = cloud.xyz.mean(0)
    local = (cloud.xyz - centre).astype("<f4")
    features = {"POINTS_LENGTH": cloud.count, "RTC_CENTER": list(centre), "POSITION": {"byteOffset": 0},
                "RGB": {"byteOffset": 12 * cloud.count}}
    files.write("plain.pnts", pnts(features, local.tobytes() + cloud.rgb.tobytes()), rgb=0)
    packed = DracoPy.encode(local, colors=cloud.rgb, quantization_bits=14)
    features["extensions"] = {"3DTILES_draco_point_compression": {"properties": {"POSITION": 0, "RGB": 1},
                                                                  "byteOffset": 0, "byteLength": len(packed)}}
    files.write("draco.pnts", pnts(features, packed), rgb=0, tolerance=1e-3)


def disagreements(cloud, ours, points=None, times=1, faces=0, rgb=None, normals=False, z=None, tolerance=2e-6,
                  shift=0.0, **names):
    count = (points or cloud.count) * times
    if ours["kept"] != count:
        yield f"{ours['kept']} points, not {count}"
    if ours["faces"] != faces:
        yield f"{ours['faces']} faces, not {faces}"
    placed = cloud.xyz + [shift, 0, 0]
    expected = [(c.min(), c.max(), times * c.sum()) for c in placed.T] if points is None else [None, None, z]
    for axis, wanted in enumerate(expected):
        own = ours["positions"][axis]
        if wanted and not np.allclose([own["min"], own["max"], own["sum"] / count],
                                      [wanted[0], wanted[1], wanted[2] / count], rtol=0, atol=tolerance):
            yield f"axis {axis}: {own}, not {wanted}"
    if points is None and ours["normals"] != normals:
        yield "normals"
    for channel in range(3 if rgb is not None else 0):
        if not ours["colors"] or abs(ours["colors"][channel]["sum"] - cloud.rgb[:, channel].sum()) > rgb:
            yield f"colour {channel}"
    attributes = {each["name"]: each for each in ours["attributes"]}
    for name in names:
        total = times * getattr(cloud, name).astype(float).sum()
        if name not in attributes or abs(attributes[name]["sum"] - total) > 1e-4 * count:
            yield name


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("bin_dir")
    parser.add_argument("--points", type=int, default=80)
    options = parser.parse_args()
    cloud, wrong = Cloud(options.points), 0
    with tempfile.TemporaryDirectory() as folder:
        files = Files(folder)
        for write in (write_numpy, write_tiff, write_stl, write_bags, write_moving_bag, write_mcaps, write_vtk, write_pnts):
            write(cloud, files)
        for path, expected in files.expected.items():
            done = subprocess.run([os.path.join(options.bin_dir, "read_scan"), "--content", path], capture_output=True,
                                  text=True, timeout=300)
            found = (list(disagreements(cloud, json.loads(done.stdout), **expected)) if done.returncode == 0
                     else [done.stderr.strip()])
            wrong += bool(found)
            print(f"| {os.path.basename(path)} | {'; '.join(found) or 'right'} |")
    print(f"{len(files.expected)} files, {wrong} disagree")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
