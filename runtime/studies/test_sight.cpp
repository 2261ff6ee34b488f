// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "pointrt/studies.hpp"
#include "runtime/studies/point_rays.h"
#include "runtime/studies/point_rows.h"
#include "runtime/studies/unoccluded.h"

namespace pointrt {
namespace {

void requireObserver(const Observer& observer) {
    const auto& [x, y, z] = observer.eye;
    if (!std::isfinite(x + y + z))
        throw TraceError(TraceError::Kind::kBadUsage, "the position of an observer must be finite");
    if (!(observer.radius > 0))
        throw TraceError(TraceError::Kind::kBadUsage, "the radius of an observer must be above 0");
}

} // namespace

std::uint64_t testSight(const TraceScene& scene, const StudyPoints& points, const Observer& observer,
                        const StudyRules& rules, std::span<std::uint8_t> visible) {
    requireRows(points, visible.size(), rules);
    requireObserver(observer);
    const Vec3 eye{observer.eye[0], observer.eye[1], observer.eye[2]};
    const auto has_ray = [&](std::size_t i) {
        const StudyDisc disc = discAt(points, i, rules);
        const double distance = length(eye - disc.center);
        visible[i] = distance == 0; // an observer at the point
        return distance > 0 && distance <= observer.radius && isFacing(disc, eye - disc.center);
    };
    const auto make = [&](std::size_t i) { return rayToObserver(discAt(points, i, rules), eye); };
    std::uint64_t cast = 0;
    for (std::size_t first = 0; first < visible.size(); first += kRaysAtOnce) {
        PointRays sights;
        appendRays(first, std::min(visible.size(), first + kRaysAtOnce), has_ray, make, sights);
        std::vector<std::uint8_t> unoccluded(sights.rays.size());
        cast += findUnoccluded(scene, sights.rays, unoccluded);
        for (std::size_t i = 0; i < unoccluded.size(); ++i) visible[sights.points[i]] = unoccluded[i];
    }
    return cast;
}

} // namespace pointrt
