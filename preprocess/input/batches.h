// SPDX-License-Identifier: GPL-3.0-or-later
// Points handed on in batches while they are read, so that memory is bounded whatever the files hold. What the whole of
// a scan decides, such as the scale of its colours, comes out of one reading and is used in the next.
#pragma once

#include <Eigen/Geometry>
#include <functional>
#include <string>
#include <vector>

#include "preprocess/cloud/cloud.h"

namespace pointrt {

/// Of points without a colour among others that have some.
inline constexpr Rgb8 kGreyColor = {200, 200, 200};

/// Points of one scan.
struct PointBatch {
    /// Arrays that are not as long as positions are absent: normals, colours, radii of files without them, attributes
    /// of values that are all 0. Its positions are not to be used.
    const Cloud& cloud;
    const std::vector<Vec3d>& positions; ///< input coordinates
    std::size_t scan = 0;                ///< its number
    /// Names of attributes whose types are but the reader's, so far: Columns::loose.
    const std::vector<std::string>& loose;
};

/// Where a Sink's points go.
struct Batches {
    std::size_t points = std::size_t{1} << 20; ///< from so many on they are handed on
    std::function<void(const PointBatch&)> take;
    /// Largest values of the scans' colours, of those that come in more than bytes. What the first reading finds, in
    /// which batches have no such colours.
    std::vector<float> largest_color;
    bool scales_known = false; ///< largest_color comes from an earlier reading
    bool colors = false;       ///< some scan had any, once all are read

    std::vector<Vec3d> positions; ///< of the cloud's points, which are the next batch
    std::uint64_t handed_on = 0;
    Eigen::AlignedBox3d scan_box; ///< of the scan's points that are handed on

    /// Makes room for the next batch; arrays keep their memory and attributes their types.
    void empty(Cloud& cloud);
};

} // namespace pointrt
