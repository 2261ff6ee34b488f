// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/ingest/scan_faces.h"

#include <algorithm>

namespace pointrt {

void ScanFaces::begin(const Cloud& cloud, bool has_faces) {
    has_faces_ = has_faces;
    first_position_ = cloud.positions.size();
    first_triangle_ = cloud.triangles.size();
    dropped_.clear();
}

void ScanFaces::drop(std::uint64_t index) {
    if (has_faces_) dropped_.push_back(static_cast<std::uint32_t>(index));
}

void ScanFaces::addPolygon(Cloud& cloud, std::span<const std::uint32_t> corners, bool mirrored,
                           const PolygonPaint& color, MeshPaint& paint) {
    for (std::size_t i = 2; i < corners.size(); ++i) {
        const std::size_t second = mirrored ? i : i - 1, third = mirrored ? i - 1 : i;
        if (color.picture != FacePaint::kNone) {
            paint.faces.resize(cloud.triangles.size());
            paint.faces.push_back(color.ofTriangle(0, second, third));
        }
        cloud.triangles.push_back({corners[0], corners[second], corners[third]});
    }
}

void ScanFaces::finish(Cloud& cloud, const InputFile& input, std::uint64_t vertices, MeshPaint& paint) {
    auto& triangles = cloud.triangles;
    std::size_t kept = first_triangle_;
    for (std::size_t i = first_triangle_; i < triangles.size(); ++i) {
        auto triangle = triangles[i];
        if (!convert(input, vertices, triangle)) continue;
        if (i < paint.faces.size()) paint.faces[kept] = paint.faces[i];
        triangles[kept++] = triangle;
    }
    if (paint.faces.size() > kept) paint.faces.resize(kept);
    triangles.resize(kept);
}

/// File indices to cloud indices. Returns false if a corner was dropped, and then records the others.
bool ScanFaces::convert(const InputFile& input, std::uint64_t vertices, std::array<std::uint32_t, 3>& triangle) {
    std::size_t count = 0;
    for (const std::uint32_t corner : triangle) {
        if (corner >= vertices) refuse(input, fmt::format("face: vertex index {} is out of range", corner));
        const auto before = std::lower_bound(dropped_.begin(), dropped_.end(), corner);
        if (before != dropped_.end() && *before == corner) continue;
        triangle[count++] = static_cast<std::uint32_t>(corner - (before - dropped_.begin()) + first_position_);
    }
    if (count == 3) return true;
    corners_of_removed_faces_.insert(corners_of_removed_faces_.end(), triangle.begin(),
                                     triangle.begin() + std::ptrdiff_t(count));
    return false;
}

} // namespace pointrt
