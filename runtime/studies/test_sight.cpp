// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "pointrt/studies.hpp"
#include "runtime/studies/occlusion/open_rays.h"
#include "runtime/studies/occlusion/point_rows.h"

namespace pointrt {
namespace {

void requireObserver(const Observer& observer) {
    const auto& [x, y, z] = observer.eye;
    if (!std::isfinite(x + y + z))
        throw TraceError(TraceError::Kind::kBadUsage, "an observer must be where numbers are finite");
    if (!(observer.radius > 0)) throw TraceError(TraceError::Kind::kBadUsage, "an observer's radius must be above 0");
}

/// Lines of sight of some points.
struct Sights {
    std::vector<Departure> rays;
    std::vector<std::size_t> points;
};

std::uint64_t castSights(const TraceScene& scene, Sights& sights, std::span<std::uint8_t> visible) {
    std::vector<std::uint8_t> open(sights.rays.size());
    const std::uint64_t cast = findOpen(scene, sights.rays, open);
    for (std::size_t i = 0; i < open.size(); ++i) visible[sights.points[i]] = open[i];
    sights = {};
    return cast;
}

} // namespace

std::uint64_t testSight(const TraceScene& scene, const StudyPoints& points, const Observer& observer,
                        const StudyRules& rules, std::span<std::uint8_t> visible) {
    requireRows(points, visible.size(), rules);
    requireObserver(observer);
    const Vec3 eye{observer.eye[0], observer.eye[1], observer.eye[2]};
    std::uint64_t cast = 0;
    Sights sights;
    for (std::size_t i = 0; i < visible.size(); ++i) {
        const StudyDisc disc = discAt(points, i, rules);
        const double distance = length(eye - disc.center);
        visible[i] = distance == 0; // an eye on the very point
        if (distance == 0 || distance > observer.radius || !isFaced(disc, eye - disc.center)) continue;
        sights.rays.push_back(leaveFor(disc, eye));
        sights.points.push_back(i);
        if (sights.rays.size() == kDeparturesAtOnce) cast += castSights(scene, sights, visible);
    }
    return cast + castSights(scene, sights, visible);
}

} // namespace pointrt
