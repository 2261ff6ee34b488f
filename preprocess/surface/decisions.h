// SPDX-License-Identifier: GPL-3.0-or-later
// Decisions for a whole cloud, used to estimate its parts.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "preprocess/cloud/splats.h"
#include "preprocess/surface/fill.h"
#include "preprocess/surface/noise.h"
#include "preprocess/surface/surround.h"

namespace pointrt {

struct SurfaceReport;

/// Statistics of a cloud. Parts of the cloud use them as decisions, and decide for themselves if a value is missing.
struct CloudStatistics {
    std::vector<float> noise; ///< [scans] standard deviation across the surface over the spacing; empty: not measured
    std::optional<bool> scattered;          ///< whether some points are scattered in space, such as foliage
    std::optional<std::uint32_t> fill_rows; ///< limit of rows between scan lines (rowsToFill); 0: none
    std::optional<float> radius_limit;      ///< input units, before radius_scale; infinity: none
    std::optional<float> common_reach;      ///< input units: commonReach (outliers.h)
    bool volume = false;                    ///< hardly any point is on a surface (balls.h)
    std::optional<surface::Thinning> thinning;
};

/// Decisions made for the larger cloud that this one is a part of; empty: this cloud decides.
struct SurfaceDecisions {
    std::vector<Vec3f> sides; ///< [points of the cloud] unit direction that the normal should face; zero: unknown
    CloudStatistics statistics;
    /// [points of the cloud] flagSilhouettes of the larger cloud, since this one has no grids; empty: its own grids
    /// decide.
    std::vector<std::uint8_t> silhouettes;
    /// [points of the cloud] 1: the neighbourhood is complete, 0: the cloud was cut there; empty: all are complete.
    /// Only these count in the SurfaceReport for StatisticsSampler.
    std::vector<std::uint8_t> inner;
};

/// Statistics of a cloud, sampled at several places in it; common_reach is left out.
class StatisticsSampler {
public:
    /// @param splats of one place, estimated with radius_limit infinity and radius_scale 1
    void add(const SurfaceReport& report, const Splats& splats);

    /// Empty for fewer than kMinPointsForPlanarity points, and the noise for fewer than kFewForNoise.
    CloudStatistics statistics();

private:
    std::size_t points_ = 0, scattered_ = 0;
    surface::FillCounts filling_{};
    surface::SurroundCounts surround_;
    surface::NoiseSamples noise_;
    std::vector<float> radii_;
};

} // namespace pointrt
