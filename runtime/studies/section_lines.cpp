// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "runtime/measure/given_points.h"
#include "runtime/studies/section_sweep.h"
#include "runtime/util/vec_array.h"

namespace pointrt {
namespace {

/// Hits this far apart are linked as neighbours, whatever the gap: see linkHits.
constexpr double kClosedSteps = 2.5;

void requireRules(const SectionRules& rules) {
    for (const double length : {rules.step, rules.gap, rules.tolerance, rules.shortest})
        if (!(length >= 0 && std::isfinite(length))) refuseMeasure("lengths of a section must be finite and 0 or more");
    if (rules.step == 0) refuseMeasure("the step of a section must be above 0");
}

void requirePlane(const SectionPlane& plane) {
    constexpr double kUnitError = 1e-6;
    const Vec3 right = vectorOf(plane.right), up = vectorOf(plane.up), point = vectorOf(plane.point);
    const bool is_square = std::abs(length(right) - 1) < kUnitError && std::abs(length(up) - 1) < kUnitError &&
                           std::abs(dot(right, up)) < kUnitError;
    if (!is_square || !std::isfinite(dot(point, point)))
        refuseMeasure("a section needs a finite point and two perpendicular axes of unit length");
}

SectionLine placed(const PlaneLine& line, const SectionPlane& plane) {
    SectionLine in_space{line.closed, {}};
    for (const Vec2 at : line.points)
        in_space.points.push_back(
            arrayOf(vectorOf(plane.point) + at.x * vectorOf(plane.right) + at.y * vectorOf(plane.up)));
    return in_space;
}

} // namespace

std::vector<SectionLine> sectionLines(const TraceScene& scene, const SectionPlane& plane, const SectionRules& rules) {
    requireRules(rules);
    requirePlane(plane);
    const std::vector<SectionHit> hits = thinHits(sweepPlane(scene, plane, rules.step), rules.step);
    const double gap = std::max(rules.gap, kClosedSteps * rules.step);
    std::vector<SectionLine> lines;
    for (const PlaneLine& line : joinEnds(linkHits(hits, rules.step), rules.step, gap)) {
        const PlaneLine simple = simplified(line, rules.tolerance);
        if (lengthOf(simple) >= rules.shortest) lines.push_back(placed(simple, plane));
    }
    return lines;
}

} // namespace pointrt
