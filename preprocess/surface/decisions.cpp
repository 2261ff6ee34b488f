// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/surface/decisions.h"

#include <algorithm>

#include "preprocess/cloud/clean_noise.h"
#include "preprocess/surface/balls.h"
#include "preprocess/surface/estimate.h"
#include "preprocess/surface/planarity.h"
#include "preprocess/surface/radii.h"

namespace pointrt {

void StatisticsSampler::add(const SurfaceReport& report, const Splats& splats) {
    points_ += report.inner;
    scattered_ += report.scattered;
    for (std::size_t i = 0; i < filling_.size(); ++i) filling_[i] += report.filling[i];
    radii_.insert(radii_.end(), splats.radii.begin(), splats.radii.end());
    const surface::NoiseSamples& noise = report.noise_samples;
    noise_.over_spacing.resize(std::max(noise_.over_spacing.size(), noise.over_spacing.size()));
    noise_.in_clumps.resize(noise_.over_spacing.size());
    for (std::size_t scan = 0; scan < noise.over_spacing.size(); ++scan) {
        const std::vector<float>& values = noise.over_spacing[scan];
        noise_.over_spacing[scan].insert(noise_.over_spacing[scan].end(), values.begin(), values.end());
        noise_.in_clumps[scan] += noise.in_clumps[scan];
    }
    surface::addCounts(surround_, report.surround);
}

CloudStatistics StatisticsSampler::statistics() {
    if (points_ < surface::kMinPointsForPlanarity) return {};
    return {points_ < kFewForNoise ? std::vector<float>() : surface::noiseOf(noise_),
            surface::isScattered(scattered_, points_),
            surface::rowsToFill(filling_, points_),
            surface::radiusLimit(radii_),
            {},
            surface::isVolume(scattered_, points_),
            surface::thinningOf(surround_)};
}

} // namespace pointrt
