// SPDX-License-Identifier: GPL-3.0-or-later
// Meshes as clouds: normals of their vertices, points sampled over their faces.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "format/base/error.h"
#include "preprocess/cloud/cloud.h"
#include "preprocess/ingest/mesh_paint.h"
#include "preprocess/ingest/scan_traits.h"

namespace pointrt {

/// Gives each vertex of a face that has no normal (no array, or zero) the mean of its faces' normals, each weighted by
/// its angle at the vertex, so that the triangulation does not matter (Thuermer and Wuethrich, "Computing vertex
/// normals from polygonal facets", 1998). Unit length; vertices without faces, or whose faces cancel, keep zero.
void addMeshNormals(Cloud& cloud);

/// Which meshes to sample, and with how many points.
struct MeshSampling {
    std::vector<bool> scans;  ///< [scans], true: its faces are sampled
    std::uint64_t points = 0; ///< over the faces of all of these; 0: no mesh is sampled
};

/// Given a number, samples all meshes with that many points, or none if it is 0. Without a number, selects, with a note
/// for each, meshes whose discs would stand off their faces and meshes with textures, since vertices would lose most of
/// the pictures. Takes about twice as many points as a picture of the meshes has pixels, 100,000 to a million; meshes
/// of half a million vertices or more are not sampled. cloud.normals must hold a normal per vertex (addMeshNormals).
MeshSampling chooseSampling(Cloud& cloud, const std::vector<ScanRange>& scans, std::optional<std::uint64_t> count,
                            const MeshPaint& paint = {});

/// Gives the corners of painted faces the colours at their places.
void paintVertices(const MeshPaint& paint, Cloud& cloud);

/// Throws Error (kBadUsage): a file without faces cannot be sampled.
[[noreturn]] void refuseSampling(const std::string& file);

/// Drops and counts the vertices of meshes that no face uses: leftovers of editing lie inside or beside the surface. A
/// file whose faces use less than a tenth of its vertices is a cloud with some faces: its points stay, with a note.
/// Vertices of sampled meshes are only counted.
/// @param removed_corners vertices that count as used (Sink::cornersOfRemovedFaces)
void dropUnused(Cloud& cloud, std::vector<ScanRange>& scans, const std::vector<std::uint32_t>& removed_corners,
                const std::vector<bool>& sampled);

/// Keeps the points whose flag is set, with their attributes. Faces must not use other points.
void keepPoints(Cloud& cloud, const std::vector<bool>& keep);

/// Replaces the vertices of sampled meshes by points spread evenly over all of their faces, with unit normals,
/// the colours of painted faces or interpolated ones, and the attributes of the nearest corner; other points stay, in
/// front. Removes the faces. The same seed gives the same points. cloud.normals must hold a normal per vertex
/// (addMeshNormals). Returns the number of samples of each scan. Throws Error, which names the first sampled mesh, if
/// the faces have no area.
std::vector<std::uint64_t> sampleMeshes(Cloud& cloud, const std::vector<ScanRange>& scans, const MeshSampling& sampling,
                                        std::uint64_t seed, MeshPaint& paint);

/// The scan of a point; the ranges of scans are consecutive.
std::size_t scanOf(const std::vector<ScanRange>& scans, std::size_t point);

} // namespace pointrt
