// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <numbers>
#include <vector>

namespace pointrt::surface {

/// The widest empty angle between directions, and the next.
struct EmptyAngles {
    float widest = 2 * std::numbers::pi_v<float>, second = 2 * std::numbers::pi_v<float>;
};

/// @param angles sorted
inline EmptyAngles gapsBetween(const std::vector<float>& angles) {
    EmptyAngles gaps;
    if (angles.size() < 2) return gaps;
    gaps = {0, 0};
    float before = angles.back() - 2 * std::numbers::pi_v<float>;
    for (const float angle : angles) {
        const float gap = angle - before;
        gaps.second = std::max(gaps.second, std::min(gap, gaps.widest));
        gaps.widest = std::max(gaps.widest, gap);
        before = angle;
    }
    return gaps;
}

} // namespace pointrt::surface
