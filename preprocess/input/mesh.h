// SPDX-License-Identifier: GPL-3.0-or-later
// Meshes as clouds: normals of their vertices, points spread over their faces.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "preprocess/cloud/cloud.h"
#include "preprocess/input/sink.h"

namespace pointrt {

/// Gives each vertex of a face that has no normal (no array, or zero) the mean of its faces' normals, each weighted by
/// its angle at the vertex, so that the triangulation does not matter (Thuermer and Wuethrich, "Computing vertex
/// normals from polygonal facets", 1998). Unit length; vertices without faces, or whose faces cancel, keep zero.
void addMeshNormals(Cloud& cloud);

/// Which meshes are points spread over their faces, and how many those are.
struct MeshSampling {
    std::vector<bool> scans;  ///< [scans], true: its faces are sampled
    std::uint64_t points = 0; ///< over the faces of all of these; 0: none is sampled
};

/// With a number wanted: that many points, over all meshes; of 0 none. Without one the meshes whose discs would stand
/// off their faces, with a note for each: twice as many points as a picture of them has pixels, 100,000 to a million,
/// which for a mesh of more than half a million vertices is none. cloud.normals must hold a normal per vertex
/// (addMeshNormals).
MeshSampling chooseSampling(Cloud& cloud, const std::vector<ScanRange>& scans, std::optional<std::uint64_t> wanted);

/// Throws Error (kBadUsage): samples are wanted of a file that has no faces.
[[noreturn]] void refuseSampling(const std::string& file);

/// Drops the vertices of meshes that no face uses, and counts them: what programs leave behind lies inside or beside
/// the surface. A file whose faces use less than a tenth of its vertices is a cloud with some faces: its points stay,
/// and a note says so. bereft: vertices that count as used (Sink). Of sampled meshes it only counts and says.
void dropUnused(Cloud& cloud, std::vector<ScanRange>& scans, const std::vector<std::uint32_t>& bereft,
                const std::vector<bool>& sampled);

/// Keeps the points whose flag is set, with all that belongs to them. Faces must not use others.
void keepPoints(Cloud& cloud, const std::vector<bool>& keep);

/// Replaces the vertices of sampled meshes by points spread evenly over all of their faces, with unit normals,
/// interpolated colours and the attributes of the nearest corner; other points stay, in front. The faces go. The same
/// seed gives the same points. cloud.normals must hold a normal per vertex (addMeshNormals).
/// Returns the number of samples of each scan. Throws Error, which names the first of them, when the faces have no
/// area.
std::vector<std::uint64_t> sampleMeshes(Cloud& cloud, const std::vector<ScanRange>& scans, const MeshSampling& sampling,
                                        std::uint64_t seed);

/// The scan that a point belongs to; scans lie one after the other.
std::size_t scanOf(const std::vector<ScanRange>& scans, std::size_t point);

} // namespace pointrt
