// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/tiles/tile_splats.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "pointrt/pro.h"
#include "preprocess/cloud/median.h"

namespace pointrt {

namespace {

using Squares = std::vector<double>;

/// Squared distances, in steps, from one code to a range of codes around it.
void squaresAround(const std::vector<PositionCode>& sorted, std::size_t at, std::size_t window, Squares& squares) {
    squares.clear();
    const std::size_t begin = at - std::min(at, window), end = std::min(sorted.size(), at + window + 1);
    for (std::size_t i = begin; i < end; ++i) {
        if (i == at) continue;
        double sum = 0;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const double way = sorted[i][axis] - sorted[at][axis];
            sum += way * way;
        }
        squares.push_back(sum);
    }
}

} // namespace

SplatsView viewOf(const TileSplats& splats) {
    SplatsView view;
    view.positions = splats.positions;
    view.normals = splats.normals;
    view.radii = splats.radii;
    view.colors = splats.colors;
    view.noise = splats.noise;
    for (const Attribute& each : splats.attributes) view.attributes.push_back({each.values.data(), each.bytesEach()});
    return view;
}

std::uint32_t normalWord(const Vec3f& normal) {
    const pro_splat plain{{0, 0, 0}, {normal.x(), normal.y(), normal.z()}, 1, {0, 0, 0}, 0};
    std::uint32_t words[PRO_SPLAT_WORDS];
    pro_splat_encode(&plain, 1, 0, words);
    return words[2] | (normal.isZero(0) ? kBallNormal : 0u);
}

Vec3f normalOf(std::uint32_t word) {
    if (word & kBallNormal) return Vec3f::Zero();
    const std::uint32_t words[PRO_SPLAT_WORDS] = {0, 0, word, 0};
    pro_splat plain;
    pro_splat_decode(words, 1, 0, &plain);
    return Vec3f(plain.normal);
}

TileSplats emptyLike(const TileSplats& splats) {
    TileSplats empty;
    for (const Attribute& each : splats.attributes)
        empty.attributes.push_back({each.name, each.type, each.components, {}});
    return empty;
}

void appendSplat(TileSplats& to, const SplatsView& from, std::size_t i, const PositionCode& position) {
    const std::size_t before = to.positions.size();
    to.positions.push_back(position);
    to.normals.push_back(from.normals[i]);
    to.radii.push_back(from.radius(i));
    if (!from.colors.empty()) to.colors.push_back(from.colors[i]);
    if (!from.noise.empty()) to.noise.resize(before, 0);
    if (!from.noise.empty() || !to.noise.empty()) to.noise.push_back(from.noise.empty() ? 0 : from.noise[i]);
    for (std::size_t a = 0; a < from.attributes.size(); ++a) {
        const char* value = from.attributes[a].data + i * from.attributes[a].bytes_each;
        to.attributes[a].values.insert(to.attributes[a].values.end(), value, value + from.attributes[a].bytes_each);
    }
}

double spacingOf(const std::vector<PositionCode>& positions, double step) {
    // The area per splat of five splats in a disc out to the fourth nearest of 64 along the curve: the spacing of
    // surface estimation, from four neighbours instead of all.
    constexpr std::size_t kWindow = 32, kNearest = 4, kSample = 4096;
    if (positions.size() < 2) return 0;
    const std::size_t stride = 1 + (positions.size() - 1) / kSample;
    std::vector<double> spacings;
    Squares squares;
    for (std::size_t at = 0; at < positions.size(); at += stride) {
        squaresAround(positions, at, kWindow, squares);
        const std::size_t place = std::min(kNearest, squares.size()) - 1;
        std::nth_element(squares.begin(), squares.begin() + static_cast<std::ptrdiff_t>(place), squares.end());
        spacings.push_back(std::sqrt(std::numbers::pi * squares[place] / (static_cast<double>(place) + 2)));
    }
    return medianInPlace(spacings) * step;
}

} // namespace pointrt
