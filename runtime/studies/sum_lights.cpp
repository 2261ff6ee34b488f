// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "pointrt/studies.hpp"
#include "runtime/studies/point_rays.h"
#include "runtime/studies/point_rows.h"
#include "runtime/studies/unoccluded.h"

namespace pointrt {
namespace {

/// Collects rays towards lights and casts them in batches.
class LightRays {
public:
    LightRays(const TraceScene& scene, const std::vector<StudyDisc>& discs, std::span<double> sums)
        : scene_(scene), discs_(discs), sums_(sums) {}

    /// @param towards the light, unit length
    void add(Vec3 towards, double weight) {
        const auto has_ray = [&](std::size_t i) { return isFacing(discs_[i], towards); };
        const auto make = [&](std::size_t i) { return rayToLight(discs_[i], towards); };
        for (std::size_t first = 0; first < discs_.size();) {
            const std::size_t last = std::min(discs_.size(), first + kRaysAtOnce - rays_.rays.size());
            appendRays(first, last, has_ray, make, rays_);
            weights_.resize(rays_.rays.size(), weight);
            first = last;
            if (kRaysAtOnce - rays_.rays.size() < kLeastRoom) cast();
        }
    }

    void cast() {
        unoccluded_.resize(rays_.rays.size());
        cast_ += findUnoccluded(scene_, rays_.rays, unoccluded_);
        for (std::size_t i = 0; i < unoccluded_.size(); ++i)
            if (unoccluded_[i] != 0) sums_[rays_.points[i]] += weights_[i];
        rays_.rays.clear();
        rays_.points.clear();
        weights_.clear();
    }

    std::uint64_t castCount() const { return cast_; }

private:
    /// If a batch has room for fewer rays than this, it is cast, and the light's next rays go into a new one.
    static constexpr std::size_t kLeastRoom = kRaysAtOnce / 8;

    const TraceScene& scene_;
    const std::vector<StudyDisc>& discs_;
    std::span<double> sums_;
    PointRays rays_;
    std::vector<double> weights_; ///< of the light of each ray
    std::vector<std::uint8_t> unoccluded_;
    std::uint64_t cast_ = 0;
};

void requireLights(const Lights& lights) {
    if (lights.directions.size() != 3 * lights.weights.size())
        throw TraceError(TraceError::Kind::kBadUsage, "lights must have a direction for each weight");
}

} // namespace

std::uint64_t sumLights(const TraceScene& scene, const StudyPoints& points, const Lights& lights,
                        const StudyRules& rules, std::span<double> sums) {
    requireRows(points, sums.size(), rules);
    requireLights(lights);
    std::vector<StudyDisc> discs(sums.size());
    forSlices(discs.size(), [&](std::size_t, std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) discs[i] = discAt(points, i, rules);
    });
    LightRays rays(scene, discs, sums);
    // light by light, since rays of neighbouring points are then parallel, which traces fastest
    for (std::size_t k = 0; k < lights.weights.size(); ++k) {
        const double* d = lights.directions.data() + 3 * k;
        rays.add({d[0], d[1], d[2]}, lights.weights[k]);
    }
    rays.cast();
    return rays.castCount();
}

} // namespace pointrt
