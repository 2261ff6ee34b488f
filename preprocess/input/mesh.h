// SPDX-License-Identifier: GPL-3.0-or-later
// Meshes as clouds: normals of their vertices, points spread over their faces.
#pragma once

#include <cstdint>

#include "preprocess/cloud/cloud.h"
#include "preprocess/input/source/sink.h"

namespace pointrt {

/// Gives each vertex of a face that has no normal (no array, or zero) the mean of its faces' normals, each weighted by
/// its angle at the vertex, so that the triangulation does not matter (Thuermer and Wuethrich, "Computing vertex
/// normals from polygonal facets", 1998). Unit length; vertices without faces, or whose faces cancel, keep zero.
void addMeshNormals(Cloud& cloud);

/// Drops the vertices of meshes that no face uses, and counts them: what programs leave behind lies inside or beside
/// the surface. A file whose faces use less than a tenth of its vertices is a cloud with some faces: its points stay,
/// and a note says so. bereft: vertices that count as used (Sink). dry: only counts and says.
void dropUnused(Cloud& cloud, const std::vector<ScanRange>& scans, const std::vector<std::uint32_t>& bereft, bool dry);

/// Notes the meshes whose faces are so large that splats at their vertices are giant discs.
void noteCoarseMeshes(Cloud& cloud, const std::vector<ScanRange>& scans);

/// Replaces the vertices of scans with faces by sample_count points spread evenly over all faces, with unit normals and
/// interpolated colours; points of other scans stay, in front. The faces go. The same seed gives the same points.
/// cloud.normals must hold a normal per vertex (addMeshNormals). Throws Error when the faces have no area.
void sampleMeshes(Cloud& cloud, const std::vector<ScanRange>& scans, std::uint64_t sample_count, std::uint64_t seed);

} // namespace pointrt
