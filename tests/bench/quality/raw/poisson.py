#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Screened Poisson reconstruction (Kazhdan and Hoppe 2013) of a raw scan by Open3D, for comparison.

  poisson.py POINTS.ply OUT.ply [--depth 9] [--cut 0.03]

POINTS.ply has oriented normals. Cuts the sparsest share of the vertices, as Open3D's tutorial does; otherwise the surface
would close far from any sample. Prints the seconds of the reconstruction. Needs open3d (PyPI).
"""
import argparse
import time

import numpy as np
import open3d


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("points")
    parser.add_argument("out")
    parser.add_argument("--depth", type=int, default=9)
    parser.add_argument("--cut", type=float, default=0.03)
    options = parser.parse_args()
    cloud = open3d.io.read_point_cloud(options.points)
    start = time.perf_counter()
    mesh, densities = open3d.geometry.TriangleMesh.create_from_point_cloud_poisson(cloud, depth=options.depth)
    densities = np.asarray(densities)
    mesh.remove_vertices_by_mask(densities < np.quantile(densities, options.cut))
    print("%.1f" % (time.perf_counter() - start))
    mesh.compute_vertex_normals()
    open3d.io.write_triangle_mesh(options.out, mesh)


main()
