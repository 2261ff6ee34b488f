// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "format/pro/checks.h"

namespace pointrt::format {

namespace {

// In input units. Squares of scaled lengths stay finite in float, and their inverses stay normal.
constexpr double kLargest = 1e30;
constexpr double kSmallestScale = 1e-30;

/// False for NaN.
bool within(double value, double low, double high) { return value >= low && value <= high; }

bool allWithin(const double values[3], double low, double high) {
    return within(values[0], low, high) && within(values[1], low, high) && within(values[2], low, high);
}

void checkCounts(const pro_info& info, Findings& findings) {
    if (info.splat_count == 0) findings.add(Finding::kHeaderCounts, "no splats");
    if (info.node_count == 0 || info.node_count % PRO_GROUP_SIZE != 0)
        findings.add(Finding::kHeaderCounts, "%u nodes, not a multiple of 8 above 0", info.node_count);
    if (info.leaf_count == 0 || info.leaf_count >= PRO_NODE_GROUP_MASK)
        findings.add(Finding::kHeaderCounts, "%u filled leaves, not 1 to 2147483646", info.leaf_count);
    if (info.material_count == 0 || info.material_count > 256)
        findings.add(Finding::kHeaderCounts, "%u materials, not 1 to 256", info.material_count);
}

} // namespace

void checkRanges(const pro_info& info, Findings& findings) {
    checkCounts(info, findings);
    if (info.max_depth > PRO_MAX_DEPTH)
        findings.add(Finding::kMaxDepthRange, "depth %u is above %u", info.max_depth, PRO_MAX_DEPTH);
    if (!within(info.radius_max, PRO_RADIUS_MIN, 4))
        findings.add(Finding::kRadiusMax, "largest radius %g is not in [2^-60, 4]", double{info.radius_max});
    if (!within(info.radius_step, 0, 1))
        findings.add(Finding::kRadiusStep, "radius step %g is not in [0, 1]", double{info.radius_step});
    if (!within(info.blend_slab, 0, 4))
        findings.add(Finding::kBlendSlab, "blending slab %g is not in [0, 4]", double{info.blend_slab});
    if (!within(info.scale, kSmallestScale, kLargest))
        findings.add(Finding::kFrame, "scale %g is not in [1e-30, 1e30]", info.scale);
    if (!allWithin(info.origin, -kLargest, kLargest))
        findings.add(Finding::kFrame, "origin (%g, %g, %g) is not in [-1e30, 1e30]", info.origin[0], info.origin[1],
                     info.origin[2]);
    for (int axis = 0; axis < 3; ++axis) {
        const double low = info.bounds_min[axis], high = info.bounds_max[axis];
        if (!within(low, -kLargest, kLargest) || !within(high, low, kLargest))
            findings.add(Finding::kBounds, "bounds %g to %g in %c are not ordered within [-1e30, 1e30]", low, high,
                         "xyz"[axis]);
    }
}

} // namespace pointrt::format
