// SPDX-License-Identifier: Apache-2.0
#include "runtime/studies/returns.h"

#include <algorithm>
#include <tuple>

namespace pointrt {
namespace {

LidarReturn returnOf(std::span<const RayEcho> echoes) {
    LidarReturn sum{0, 0, echoes[0]};
    double range = 0;
    for (const RayEcho& echo : echoes) {
        sum.power += echo.power;
        sum.range += echo.power * echo.range;
        range += echo.range;
        if (echo.power > sum.strongest.power) sum.strongest = echo;
    }
    // black surfaces return no power but have a range
    sum.range = sum.power > 0 ? sum.range / sum.power : range / static_cast<double>(echoes.size());
    return sum;
}

} // namespace

void findReturns(std::span<RayEcho> echoes, double resolution, std::vector<LidarReturn>& returns) {
    returns.clear();
    std::sort(echoes.begin(), echoes.end(), [](const RayEcho& a, const RayEcho& b) {
        return std::tie(a.range, a.splat, a.instance, a.tile) < std::tie(b.range, b.splat, b.instance, b.tile);
    });
    for (std::size_t first = 0, end = 0; first < echoes.size(); first = end) {
        end = first + 1;
        while (end < echoes.size() && echoes[end].range - echoes[end - 1].range <= resolution) ++end;
        returns.push_back(returnOf(echoes.subspan(first, end - first)));
    }
}

} // namespace pointrt
