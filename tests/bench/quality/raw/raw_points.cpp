// SPDX-License-Identifier: Apache-2.0
#include "tests/bench/quality/raw/raw_points.h"

#include <array>

#include "preprocess/input/read.h"

namespace pointrt::quality {

namespace {

std::vector<Vec3f> readPositions(const std::vector<std::string>& paths, const UnitFrame& frame) {
    const Cloud cloud = readInputs(paths, {});
    std::vector<Vec3f> positions;
    positions.reserve(cloud.positions.size());
    for (const Vec3f& position : cloud.positions)
        positions.push_back(frame.unitFromInput(cloud.origin + position.cast<double>()));
    return positions;
}

} // namespace

RawPoints::RawPoints(std::vector<Vec3f> positions) : positions_(std::move(positions)), search_(positions_) {}

bool RawPoints::isSampled(const Vec3f& place, float reach) const {
    std::uint32_t nearest = 0;
    float squared = 0;
    return search_.nearest(place, {&nearest, 1}, {&squared, 1}, reach * reach) == 1;
}

float RawPoints::spacingAt(const Vec3f& place) const {
    std::array<std::uint32_t, kSpacingPoints + 1> indices; // and the point itself
    std::array<float, kSpacingPoints + 1> squared;
    search_.nearest(place, {indices.data(), 1}, {squared.data(), 1});
    const std::size_t found = search_.nearest(positions_[indices[0]], indices, squared);
    return surface::spacingFromRadius(std::sqrt(squared[found - 1]), found - 1);
}

RawPoints loadRawPoints(const std::vector<std::string>& paths, const UnitFrame& frame) {
    return RawPoints(readPositions(paths, frame));
}

} // namespace pointrt::quality
