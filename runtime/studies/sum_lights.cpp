// SPDX-License-Identifier: Apache-2.0
#include "pointrt/studies.hpp"
#include "runtime/studies/occlusion/open_rays.h"
#include "runtime/studies/occlusion/point_rows.h"

namespace pointrt {
namespace {

/// Rays towards lights until there are enough of them to be cast.
class LightRays {
public:
    LightRays(const TraceScene& scene, std::span<double> sums) : scene_(scene), sums_(sums) {}

    void add(std::size_t point, double weight, const Departure& ray) {
        rays_.push_back(ray);
        targets_.push_back({point, weight});
        if (rays_.size() == kDeparturesAtOnce) cast();
    }

    void cast() {
        open_.resize(rays_.size());
        cast_ += findOpen(scene_, rays_, open_);
        for (std::size_t i = 0; i < rays_.size(); ++i)
            if (open_[i] != 0) sums_[targets_[i].point] += targets_[i].weight;
        rays_.clear();
        targets_.clear();
    }

    std::uint64_t castCount() const { return cast_; }

private:
    struct Target {
        std::size_t point;
        double weight;
    };
    const TraceScene& scene_;
    std::span<double> sums_;
    std::vector<Departure> rays_;
    std::vector<Target> targets_;
    std::vector<std::uint8_t> open_;
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
    std::vector<StudyDisc> discs;
    discs.reserve(sums.size());
    for (std::size_t i = 0; i < sums.size(); ++i) discs.push_back(discAt(points, i, rules));
    LightRays rays(scene, sums);
    // light by light: neighbours' rays run beside each other, which is how they are traced fastest
    for (std::size_t k = 0; k < lights.weights.size(); ++k) {
        const double* d = lights.directions.data() + 3 * k;
        const Vec3 towards{d[0], d[1], d[2]};
        for (std::size_t i = 0; i < discs.size(); ++i)
            if (isFaced(discs[i], towards)) rays.add(i, lights.weights[k], leaveTowards(discs[i], towards));
    }
    rays.cast();
    return rays.castCount();
}

} // namespace pointrt
