// SPDX-License-Identifier: GPL-3.0-or-later
// What a sensor saw, by direction.
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <vector>

#include "preprocess/cloud/cloud.h"

namespace pointrt::surface {

struct SightExtent {
    float least, most;
};

/// The points that one sensor saw, relative to it, in the cells of a cube around it: of each of its faces only the
/// rectangle that they fill.
class SightMap {
public:
    /// seen: relative to the sensor, in a fixed order; what lies at the sensor itself is left out.
    explicit SightMap(const std::vector<Vec3f>& seen);

    /// Calls body(seen) for all points that lie in cells which a line of sight through the box may cross, box relative
    /// to the sensor. Only faces of the cube that the box lies wholly ahead of are looked at: nothing where the sensor
    /// stands in it.
    template <typename Body>
    void forSights(const Eigen::AlignedBox3f& box, const Body& body) const {
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
    /// Empty where last_row < first_row.
    struct Range {
        int first_row = 0, last_row = -1, first_column = 0, last_column = -1;
    };
    void layOut(const std::array<Eigen::AlignedBox2f, 6>& boxes, std::size_t count);
    void sort(const std::vector<Vec3f>& seen, std::size_t count);
    std::size_t cellOf(const Vec3f& seen) const;
    /// Places on a face, in cells from where its rectangle begins.
    SightExtent cellsOf(const SightExtent& places, float least) const;
    Range rangeOf(int side, const Eigen::AlignedBox3f& box) const;

    std::array<Face, 6> faces_;
    float cells_per_unit_ = 0;         ///< of a face, which reaches from -1 to 1
    std::vector<std::uint32_t> first_; ///< [cells + 1]
    std::vector<Vec3f> seen_;          ///< by cell
};

} // namespace pointrt::surface
