// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>

#include "format/pro/checks.h"
#include "format/pro/leaf.h"
#include "format/pro/leaf_walk.h"
#include "format/pro/position_codes.h"

namespace pointrt::format {

namespace {

/// Bounds with a tolerance: they may come from unrounded positions, half a step away, and from sums rounded at the
/// input's magnitude.
struct BoundsWithSlack {
    std::array<double, 3> low, high;

    explicit BoundsWithSlack(const pro_info& info) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const double magnitude = std::max(std::fabs(info.bounds_min[axis]), std::fabs(info.bounds_max[axis]));
            const double slack = info.scale * double{PRO_POSITION_STEP} + 1e-15 * magnitude;
            low[axis] = info.bounds_min[axis] - slack;
            high[axis] = info.bounds_max[axis] + slack;
        }
    }

    bool contain(const pro_info& info, const std::array<std::uint32_t, 3>& codes) const {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const double at = info.origin[axis] + info.scale * (codes[axis] + 0.5) * double{PRO_POSITION_STEP};
            if (!(at >= low[axis] && at <= high[axis])) return false;
        }
        return true;
    }
};

bool inCell(const Cell& cell, const std::array<std::uint32_t, 3>& codes) {
    const std::uint32_t shift = PRO_POSITION_BITS - cell.depth;
    return codes[0] >> shift == cell.x && codes[1] >> shift == cell.y && codes[2] >> shift == cell.z;
}

} // namespace

bool checkSplats(const pro_info& info, const pro_view& view, Findings& findings) {
    Tally reserved, material, radius;
    const bool may_have_balls = (info.flags & PRO_FLAG_BALLS) != 0;
    // the first code of a radius below PRO_RADIUS_MIN
    std::uint32_t code_end = 0;
    while (code_end <= PRO_RADIUS_CODE_MAX &&
           info.radius_max * std::exp2(-static_cast<float>(code_end) * info.radius_step) >= PRO_RADIUS_MIN)
        ++code_end;
    for (std::size_t i = 0; i < info.splat_count; ++i) {
        const std::uint32_t* words = view.splats + i * PRO_SPLAT_WORDS;
        if (pro_splat_is_ball(words) && !may_have_balls) reserved.hit(i);
        if (words[2] >> PRO_MATERIAL_SHIFT >= info.material_count) material.hit(i);
        if (words[3] >> PRO_RADIUS_SHIFT >= code_end) radius.hit(i);
    }
    reserved.addTo(findings, Finding::kSplatReserved, "splat", "it is a ball, but the header has no flag for balls");
    material.addTo(findings, Finding::kSplatMaterial, "splat", "its material is out of range");
    radius.addTo(findings, Finding::kSplatRadius, "splat", "its radius is below 2^-60");
    return reserved.places + material.places + radius.places == 0;
}

void checkCentres(const pro_info& info, const pro_view& view, Findings& findings) {
    Tally outside_leaf, outside_bounds;
    const BoundsWithSlack bounds(info);
    forEachLeaf(view.nodes, [&](std::uint32_t index, const Cell& cell) {
        const Leaf leaf = loadLeaf(view.leaves, index);
        for (std::size_t i = leaf.first_member; i < std::size_t{leaf.first_member} + leaf.member_count; ++i) {
            const auto codes = positionCodes(view.splats + i * PRO_SPLAT_WORDS);
            if (!inCell(cell, codes)) outside_leaf.hit(i);
            if (!bounds.contain(info, codes)) outside_bounds.hit(i);
        }
    });
    outside_leaf.addTo(findings, Finding::kSplatOutsideLeaf, "splat", "its centre is outside its leaf");
    outside_bounds.addTo(findings, Finding::kSplatOutsideBounds, "splat", "its centre is outside the header's bounds");
}

void checkMaterials(const pro_info& info, const pro_view& view, Findings& findings) {
    Tally range, reserved;
    for (std::size_t row = 0; row < info.material_count; ++row) {
        const float* material = view.materials + row * PRO_MATERIAL_FLOATS;
        bool in_range = material[PRO_MAT_SHININESS] >= 1 && material[PRO_MAT_SHININESS] <= 1000;
        for (std::size_t i = 0; i <= PRO_MAT_SPECULAR; ++i) in_range &= material[i] >= 0 && material[i] <= 1;
        if (!in_range) range.hit(row);
        if (info.version_minor > PRO_VERSION_MINOR) continue; // later minors may use more of the row
        const bool zeros = std::all_of(material + PRO_MAT_SHININESS + 1, material + PRO_MATERIAL_FLOATS,
                                       [](float value) { return value == 0; });
        if (!zeros) reserved.hit(row);
    }
    range.addTo(findings, Finding::kMaterialRange, "material", "a value is not finite or out of its range");
    reserved.addTo(findings, Finding::kMaterialReserved, "material", "a reserved value is not 0");
}

} // namespace pointrt::format
