// SPDX-License-Identifier: Apache-2.0
#include "runtime/studies/returns.h"

#include <algorithm>
#include <tuple>

namespace pointrt {
namespace {

LidarReturn returnOf(std::span<const LidarTouch> touches) {
    LidarReturn sum{0, 0, touches[0]};
    double range = 0;
    for (const LidarTouch& touch : touches) {
        sum.power += touch.power;
        sum.range += touch.power * touch.range;
        range += touch.range;
        if (touch.power > sum.strongest.power) sum.strongest = touch;
    }
    // what is black sends nothing back, but has a place
    sum.range = sum.power > 0 ? sum.range / sum.power : range / static_cast<double>(touches.size());
    return sum;
}

} // namespace

void findReturns(std::span<LidarTouch> touches, double resolution, std::vector<LidarReturn>& returns) {
    returns.clear();
    std::sort(touches.begin(), touches.end(), [](const LidarTouch& a, const LidarTouch& b) {
        return std::tie(a.range, a.splat, a.instance, a.tile) < std::tie(b.range, b.splat, b.instance, b.tile);
    });
    for (std::size_t first = 0, end = 0; first < touches.size(); first = end) {
        end = first + 1;
        while (end < touches.size() && touches[end].range - touches[end - 1].range <= resolution) ++end;
        returns.push_back(returnOf(touches.subspan(first, end - first)));
    }
}

} // namespace pointrt
