// SPDX-License-Identifier: Apache-2.0
// The summary of a file that pointrt-info prints as text or JSON.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "pointrt/pro.hpp"

namespace pointrt {

/// Nodes at one depth of the octree.
struct LevelSummary {
    std::uint64_t inner = 0, filled = 0, empty = 0;
};

struct SectionSummary {
    std::string kind;
    std::uint32_t stride = 0;
    std::uint64_t count = 0, offset = 0, bytes = 0;
    bool required = false;
};

/// Statistics of section NOIS, in radii and in input units; 0 without it.
struct NoiseSummary {
    double low_radii = 0, median_radii = 0, high_radii = 0;
    double low = 0, high = 0; ///< the median is in the header
};

/// Statistics of the sections GAUS, GHRM, GNOD, GLST and GEXA; 0 without them.
struct GaussianSummary {
    std::vector<SectionSummary> sections; ///< in the order of the file
    std::uint64_t bytes = 0;
};

struct Summary {
    pro_info info{};
    std::vector<LevelSummary> levels; ///< by depth, the root's first
    std::vector<SectionSummary> sections;
    std::uint64_t nodes = 0; ///< 1 + 8 * inner
    std::uint64_t empty_leaves = 0;
    std::uint64_t balls = 0;         ///< splats that are balls
    std::uint64_t border_leaves = 0; ///< filled leaves with references only
    std::uint64_t references = 0;    ///< members + refs
    std::uint64_t index_bytes = 0;   ///< of the sections of the tracing index, 0 without one
    NoiseSummary noise;
    GaussianSummary gaussians;
    double references_per_splat = 0, bytes_per_splat = 0;
    double position_error = 0; ///< largest distance between stored and input position, input units
    double radius_error = 0;   ///< largest relative growth of a radius
};

Summary summarize(const ProFile& file);

} // namespace pointrt
