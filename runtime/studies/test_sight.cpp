// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "pointrt/studies.hpp"
#include "runtime/studies/open_rays.h"
#include "runtime/studies/point_rays.h"
#include "runtime/studies/point_rows.h"

namespace pointrt {
namespace {

void requireObserver(const Observer& observer) {
    const auto& [x, y, z] = observer.eye;
    if (!std::isfinite(x + y + z))
        throw TraceError(TraceError::Kind::kBadUsage, "an observer must be where numbers are finite");
    if (!(observer.radius > 0)) throw TraceError(TraceError::Kind::kBadUsage, "an observer's radius must be above 0");
}

} // namespace

std::uint64_t testSight(const TraceScene& scene, const StudyPoints& points, const Observer& observer,
                        const StudyRules& rules, std::span<std::uint8_t> visible) {
    requireRows(points, visible.size(), rules);
    requireObserver(observer);
    const Vec3 eye{observer.eye[0], observer.eye[1], observer.eye[2]};
    const auto wanted = [&](std::size_t i) {
        const StudyDisc disc = discAt(points, i, rules);
        const double distance = length(eye - disc.center);
        visible[i] = distance == 0; // an eye on the very point
        return distance > 0 && distance <= observer.radius && isFaced(disc, eye - disc.center);
    };
    const auto make = [&](std::size_t i) { return leaveFor(discAt(points, i, rules), eye); };
    std::uint64_t cast = 0;
    for (std::size_t first = 0; first < visible.size(); first += kDeparturesAtOnce) {
        PointRays sights;
        addRays(first, std::min(visible.size(), first + kDeparturesAtOnce), wanted, make, sights);
        std::vector<std::uint8_t> open(sights.rays.size());
        cast += findOpen(scene, sights.rays, open);
        for (std::size_t i = 0; i < open.size(); ++i) visible[sights.points[i]] = open[i];
    }
    return cast;
}

} // namespace pointrt
