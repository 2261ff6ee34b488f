// SPDX-License-Identifier: GPL-3.0-or-later
// What only a whole cloud tells, so that its parts are to be told.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "preprocess/cloud/splats.h"
#include "preprocess/surface/fill.h"

namespace pointrt {

struct SurfaceReport;

/// What holds for all of a cloud. As a decision for a part of it: where a value is missing, the part decides.
struct CloudTraits {
    std::vector<float> noise; ///< [scans] standard deviation across the surface over the spacing; empty: not measured
    std::optional<bool> scattered;          ///< whether some points are scattered in space, as those of crowns are
    std::optional<std::uint32_t> fill_rows; ///< points in a row from a scan line half the way to the next; 0: none
    std::optional<float> radius_limit;      ///< input units, before radius_scale: of the widest disc; infinity: none is
    std::optional<float> common_reach;      ///< input units: commonReach (outliers.h)
};

/// What was decided for a larger cloud that this one is a part of; empty: this cloud decides.
struct SurfaceDecisions {
    std::vector<Vec3f> sides; ///< [points of the cloud] unit length, what the normal is to face; zero where not known
    CloudTraits traits;
    /// [points of the cloud] 1 where the surroundings are whole, 0 where the cloud was cut out; empty: all are. What
    /// SurfaceReport counts for PlacesOfCloud are these alone.
    std::vector<std::uint8_t> inner;
};

/// What several places of a cloud tell of all of it, but for its noise and how far its points reach.
class PlacesOfCloud {
public:
    /// @param splats of the place, whose radii were decided to have no limit and no scale
    void add(const SurfaceReport& report, const Splats& splats);

    /// Nothing is told by fewer points than tell sheets (dimension.h).
    CloudTraits traits();

private:
    std::size_t points_ = 0, scattered_ = 0;
    surface::FillCounts filling_{};
    std::vector<float> radii_;
};

} // namespace pointrt
