// SPDX-License-Identifier: Apache-2.0
#include "runtime/measure/given_points.h"

#include <cmath>

#include "runtime/util/vec_array.h"

namespace pointrt {

void refuseMeasure(const std::string& reason) { throw TraceError(TraceError::Kind::kBadUsage, reason); }

void requireCount(std::span<const Position> points, std::size_t least, const std::string& what) {
    if (points.size() < least)
        refuseMeasure(what + " needs at least " + std::to_string(least) + " points, not " +
                      std::to_string(points.size()));
}

std::vector<Vec3> vectorsOf(std::span<const Position> points, std::size_t least, const std::string& what) {
    requireCount(points, least, what);
    std::vector<Vec3> vectors;
    vectors.reserve(points.size());
    for (const Position& point : points) {
        vectors.push_back(vectorOf(point));
        if (!std::isfinite(dot(vectors.back(), vectors.back())))
            refuseMeasure("point " + std::to_string(vectors.size()) + " is not finite");
    }
    return vectors;
}

} // namespace pointrt
