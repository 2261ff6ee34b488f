// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/ingest/dimensions.h"

#include <algorithm>
#include <initializer_list>
#include <string>

#include "preprocess/ingest/text.h"

namespace pointrt {
namespace {

struct Alias {
    std::string_view name;
    Dimension dimension;
};

constexpr Alias kAliases[] = {
    {"x", kX},
    {"y", kY},
    {"z", kZ},
    {"nx", kNormalX},
    {"ny", kNormalY},
    {"nz", kNormalZ},
    {"normal_x", kNormalX},
    {"normal_y", kNormalY},
    {"normal_z", kNormalZ},
    {"normalx", kNormalX},
    {"normaly", kNormalY},
    {"normalz", kNormalZ},
    {"red", kRed},
    {"green", kGreen},
    {"blue", kBlue},
    {"r", kRed},
    {"g", kGreen},
    {"b", kBlue},
    {"rf", kRed}, // CloudCompare writes reals in [0, 1]
    {"gf", kGreen},
    {"bf", kBlue},
    {"diffuse_red", kRed},
    {"diffuse_green", kGreen},
    {"diffuse_blue", kBlue},
};

bool holdsAll(std::span<const Dimension> dimensions, std::initializer_list<Dimension> wanted) {
    return std::all_of(wanted.begin(), wanted.end(), [&](Dimension dimension) {
        return std::find(dimensions.begin(), dimensions.end(), dimension) != dimensions.end();
    });
}

void drop(std::span<Dimension> dimensions, Dimension first, Dimension last) {
    for (Dimension& dimension : dimensions)
        if (dimension >= first && dimension <= last) dimension = kIgnored;
}

} // namespace

Dimension dimensionOfName(std::string_view name) {
    const std::string lower = lowerCase(name);
    for (const Alias& alias : kAliases)
        if (alias.name == lower) return alias.dimension;
    return kIgnored;
}

void resolveDimensions(std::span<Dimension> dimensions) {
    bool seen[kDimensionCount] = {};
    for (Dimension& dimension : dimensions) {
        if (dimension == kIgnored) continue;
        if (seen[dimension])
            dimension = kIgnored;
        else
            seen[dimension] = true;
    }
    if (!hasNormals(dimensions)) drop(dimensions, kNormalX, kNormalZ);
    if (!hasColors(dimensions)) drop(dimensions, kRed, kBlue);
}

bool hasPositions(std::span<const Dimension> dimensions) { return holdsAll(dimensions, {kX, kY, kZ}); }
bool hasNormals(std::span<const Dimension> dimensions) { return holdsAll(dimensions, {kNormalX, kNormalY, kNormalZ}); }
bool hasColors(std::span<const Dimension> dimensions) { return holdsAll(dimensions, {kRed, kGreen, kBlue}); }

} // namespace pointrt
