// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/tiles/select_splats.h"

#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>

#include <algorithm>

#include "preprocess/cloud/curve_key.h"
#include "preprocess/cloud/gather.h"
#include "preprocess/cloud/morton.h"
#include "preprocess/tiles/level_coding.h"

namespace pointrt {

namespace {

/// Clamps codes beyond the cube, which neighbours do not read, to the cube's border.
std::uint64_t curveCode(const PositionCode& code) {
    const auto up = [](std::int32_t each) {
        return static_cast<std::uint64_t>(std::clamp(each + kRimSteps, 0, 2 * kCoreSteps - 1));
    };
    return mortonCode(up(code[0]), up(code[1]), up(code[2]));
}

std::vector<std::uint32_t> orderOf(const Splats& splats, const std::vector<PositionCode>& codes,
                                   const std::vector<std::uint8_t>& kept) {
    std::vector<CurveKey> keys;
    for (std::size_t i = 0; i < codes.size(); ++i)
        if (kept[i]) keys.push_back({curveCode(codes[i]), static_cast<std::uint32_t>(i), fillsGap(splats, i)});
    tbb::parallel_sort(keys);
    std::vector<std::uint32_t> order;
    for (const CurveKey& key : keys)
        if (order.empty() || codes[order.back()] != codes[key.index]) order.push_back(key.index);
    return order;
}

void copyValues(const Splats& splats, const std::vector<Attribute>& attributes, const std::vector<std::uint32_t>& order,
                TileSplats& taken) {
    std::vector<std::uint32_t> points;
    for (const std::uint32_t i : order) {
        const std::uint32_t point = splats.input_index[i];
        points.push_back(fillsGap(splats, i) ? splats.filled_from[point - splats.input_count] : point);
    }
    for (const Attribute& from : attributes) {
        Attribute& to = taken.attributes.emplace_back(Attribute{from.name, from.type, from.components, {}});
        to.values.resize(points.size() * from.bytesEach());
        gatherValues(from.values.data(), from.bytesEach(), points, to.values.data());
    }
}

} // namespace

std::vector<std::uint32_t> orderAlongCurve(const std::vector<PositionCode>& codes) {
    std::vector<CurveKey> keys(codes.size());
    for (std::size_t i = 0; i < codes.size(); ++i)
        keys[i] = {curveCode(codes[i]), static_cast<std::uint32_t>(i), false};
    tbb::parallel_sort(keys);
    std::vector<std::uint32_t> order;
    for (const CurveKey& key : keys) order.push_back(key.index);
    return order;
}

std::vector<PositionCode> codesOf(const TileSet& set, const TileKey& tile, const Splats& splats) {
    std::vector<PositionCode> codes(splats.positions.size());
    tbb::parallel_for(std::size_t{0}, codes.size(), [&](std::size_t i) {
        codes[i] = codeOf(set, tile, splats.origin + splats.positions[i].cast<double>());
    });
    return codes;
}

TileSplats selectSplats(const Splats& splats, const std::vector<Attribute>& attributes,
                        const std::vector<PositionCode>& codes, const std::vector<std::uint8_t>& kept, double edge) {
    const std::vector<std::uint32_t> order = orderOf(splats, codes, kept);
    const auto widest = static_cast<float>(kRadiusPerEdge * edge);
    const std::size_t count = order.size();
    TileSplats taken;
    taken.positions.resize(count);
    taken.normals.resize(count);
    taken.radii.resize(count);
    taken.colors.resize(splats.colors.empty() ? 0 : count);
    taken.noise.resize(splats.noise.empty() ? 0 : count);
    tbb::parallel_for(std::size_t{0}, count, [&](std::size_t k) {
        const std::uint32_t i = order[k];
        taken.positions[k] = codes[i];
        taken.normals[k] = normalWord(splats.normals[i]);
        taken.radii[k] = std::min(splats.radii[i], widest);
        if (!taken.colors.empty()) taken.colors[k] = splats.colors[i];
        if (!taken.noise.empty()) taken.noise[k] = splats.noise[i];
    });
    copyValues(splats, attributes, order, taken);
    taken.spacing = spacingOf(taken.positions, edge / kCoreSteps);
    return taken;
}

} // namespace pointrt
