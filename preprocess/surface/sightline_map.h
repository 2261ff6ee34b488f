// SPDX-License-Identifier: GPL-3.0-or-later
// The points that a sensor saw, by direction.
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <vector>

#include "preprocess/cloud/cloud.h"

namespace pointrt::surface {

struct SlopeRange {
    float least, most;
};

/// A cube map of the points that one sensor saw: each face of a cube around the sensor has a grid of cells over the
/// rectangle that the points cover.
class SightlineMap {
public:
    /// seen: relative to the sensor. Skips points at the sensor itself. Points of a cell keep their order.
    explicit SightlineMap(const std::vector<Vec3f>& seen);

    /// Calls body(seen) for all points in the cells of sightlines that may cross the box, which is relative to the
    /// sensor. Only tests faces of the cube whose side the box is entirely on: none if the sensor is in the box.
    template <typename Body>
    void forSightlines(const Eigen::AlignedBox3f& box, const Body& body) const {
        for (int side = 0; side < 6; ++side) {
            const Face& face = faces_[std::size_t(side)];
            if (face.columns == 0) continue;
            const Range range = rangeOf(side, box);
            for (int row = range.first_row; row <= range.last_row; ++row) {
                const std::size_t cell = face.first_cell + std::size_t(row) * std::size_t(face.columns);
                const std::uint32_t end = first_[cell + std::size_t(range.last_column) + 1];
                for (std::uint32_t i = first_[cell + std::size_t(range.first_column)]; i < end; ++i) body(seen_[i]);
            }
        }
    }

private:
    struct Face {
        float least_u = 0, least_v = 0;
        int columns = 0, rows = 0;
        std::size_t first_cell = 0;
    };
    /// Empty if last_row < first_row.
    struct Range {
        int first_row = 0, last_row = -1, first_column = 0, last_column = -1;
    };
    void layOut(const std::array<Eigen::AlignedBox2f, 6>& boxes, std::size_t count);
    void sort(const std::vector<Vec3f>& seen, std::size_t count);
    std::size_t cellOf(const Vec3f& seen) const;
    /// Converts coordinates on a face to cells from its rectangle's edge.
    SlopeRange cellsOf(const SlopeRange& places, float least) const;
    Range rangeOf(int side, const Eigen::AlignedBox3f& box) const;

    std::array<Face, 6> faces_;
    float cells_per_unit_ = 0;         ///< of a face, whose coordinates are -1 to 1
    std::vector<std::uint32_t> first_; ///< [cells + 1], offsets into seen_
    std::vector<Vec3f> seen_;          ///< by cell
};

} // namespace pointrt::surface
