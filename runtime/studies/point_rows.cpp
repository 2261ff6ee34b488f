// SPDX-License-Identifier: Apache-2.0
#include "runtime/studies/point_rows.h"

#include <cmath>
#include <string>

#include "runtime/studies/study_values.h"

namespace pointrt {
namespace {

/// The size at a row; `otherwise` if there are no sizes, 0 if it is invalid.
double sizeAt(std::span<const float> sizes, std::size_t row, double otherwise) {
    if (sizes.empty()) return otherwise;
    const double size = sizes[row];
    return std::isfinite(size) && size > 0 ? size : 0;
}

} // namespace

void requireRows(const StudyPoints& points, std::size_t count, const StudyRules& rules) {
    const auto require = [](bool holds, const char* what) {
        if (!holds) refuseUsage(std::string(what) + " must have one row per point");
    };
    require(points.positions.size() == 3 * count, "results");
    require(points.normals.empty() || points.normals.size() == 3 * count, "normals");
    require(points.radii.empty() || points.radii.size() == count, "radii");
    require(points.noise.empty() || points.noise.size() == count, "noise");
    if (!(rules.radius >= 0 && std::isfinite(rules.radius))) refuseUsage("the radius must be finite and at least 0");
}

StudyDisc discAt(const StudyPoints& points, std::size_t row, const StudyRules& rules) {
    const double* at = points.positions.data() + 3 * row;
    StudyDisc disc{{at[0], at[1], at[2]}, {rules.up[0], rules.up[1], rules.up[2]}, 0, 0, false};
    if (!std::isfinite(at[0] + at[1] + at[2]))
        throw TraceError(TraceError::Kind::kBadInput, "point " + std::to_string(row) + ": the position is not finite");
    disc.radius = sizeAt(points.radii, row, rules.radius);
    disc.noise = sizeAt(points.noise, row, 0);
    if (points.normals.empty()) return disc;
    const float* n = points.normals.data() + 3 * row;
    const Vec3 normal{n[0], n[1], n[2]};
    const double size = length(normal);
    if (!(std::isfinite(size) && size > 0)) return disc;
    disc.normal = (1 / size) * normal;
    disc.one_sided = rules.sides == Sides::kFront;
    return disc;
}

} // namespace pointrt
