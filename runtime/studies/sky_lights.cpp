// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <numbers>

#include "pointrt/studies.hpp"
#include "runtime/studies/study_values.h"
#include "runtime/util/vec.h"

namespace pointrt {
namespace {

constexpr std::size_t kMostDirections = 65536;

} // namespace

Lights skyLights(std::size_t count, const StudyFrame& frame) {
    if (count < 1 || count > kMostDirections)
        throw TraceError(TraceError::Kind::kBadUsage, "the number of sky directions must be from 1 to 65536");
    const Vec3 up = vectorOf(frame.up), north = vectorOf(frame.north), east = cross(north, up);
    Lights lights;
    lights.weights.assign(count, 1 / static_cast<double>(count));
    for (std::size_t k = 0; k < count; ++k) {
        // equal areas of the unit disc: projected up to the hemisphere, they are equal cosine-weighted solid angles
        // (Malley)
        const double area = (static_cast<double>(k) + 0.5) / static_cast<double>(count), radius = std::sqrt(area);
        const double angle = kGoldenAngle * static_cast<double>(k);
        const Vec3 towards = radius * (std::cos(angle) * north + std::sin(angle) * east) + std::sqrt(1 - area) * up;
        lights.directions.insert(lights.directions.end(), {towards.x, towards.y, towards.z});
    }
    return lights;
}

} // namespace pointrt
