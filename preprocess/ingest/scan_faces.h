// SPDX-License-Identifier: GPL-3.0-or-later
// Faces of a scan: from indices of the file's vertices to indices of the cloud's points.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "preprocess/cloud/cloud.h"
#include "preprocess/ingest/input_file.h"
#include "preprocess/ingest/mesh_paint.h"

namespace pointrt {

class ScanFaces {
public:
    /// Starts a scan. has_faces: of its traits; without faces dropped vertices are not recorded
    void begin(const Cloud& cloud, bool has_faces);

    /// Records that the file's vertex `index` is not in the cloud. Indices ascend.
    void drop(std::uint64_t index);

    /// Adds a polygon of file indices as a fan of triangles. mirrored: reverses it, as the transform would show its
    /// back
    static void addPolygon(Cloud& cloud, std::span<const std::uint32_t> corners, bool mirrored,
                           const PolygonPaint& color, MeshPaint& paint);

    /// Converts the scan's triangles to cloud indices and removes those with a dropped vertex.
    /// Throws Error if an index is not below `vertices`, the number of the file's vertices.
    void finish(Cloud& cloud, const InputFile& input, std::uint64_t vertices, MeshPaint& paint);

    /// Whether the scan has a triangle in the cloud.
    bool any(const Cloud& cloud) const { return cloud.triangles.size() > first_triangle_; }

    /// Points of all scans so far, as cloud indices, that were corners of a removed triangle.
    const std::vector<std::uint32_t>& cornersOfRemovedFaces() const { return corners_of_removed_faces_; }

private:
    bool has_faces_ = true;
    std::size_t first_position_ = 0, first_triangle_ = 0;
    std::vector<std::uint32_t> dropped_; ///< file indices, ascending
    std::vector<std::uint32_t> corners_of_removed_faces_;

    bool convert(const InputFile& input, std::uint64_t vertices, std::array<std::uint32_t, 3>& triangle);
};

} // namespace pointrt
