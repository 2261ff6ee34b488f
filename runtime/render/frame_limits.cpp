// SPDX-License-Identifier: Apache-2.0
#include "runtime/render/frame_limits.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "shaders/shared/luminance.h"

namespace pointrt {
namespace {

constexpr std::uint32_t kFirstNoise = 8;
// Each noise check comes after at least 1 / kSmallestStep more samples, so that about ten checks lead from half way to
// the target.
constexpr std::uint32_t kSmallestStep = 8;
constexpr double kDarkest = 0.01; ///< share of the mean luminance

double luminanceOf(const float* rgb) { return luminance<double>(rgb[0], rgb[1], rgb[2]); }

/// Samples needed for the noise limit, extrapolated from the last check.
double samplesForNoise(const FrameLimits& limits, const FrameState& now) {
    const double over = *now.noise / *limits.noise;
    return now.noise_samples * over * over;
}

std::uint32_t nextNoiseCheck(const FrameLimits& limits, const FrameState& now) {
    if (!now.noise) return std::max(kFirstNoise, now.samples + 1);
    if (*now.noise <= *limits.noise) return now.samples;
    const double wanted = std::ceil(samplesForNoise(limits, now));
    const std::uint32_t least = now.samples + std::max(now.samples / kSmallestStep, 1u);
    return static_cast<std::uint32_t>(std::clamp<double>(wanted, least, 2.0 * now.samples));
}

std::uint32_t nextTimeCheck(const FrameLimits& limits, const FrameState& now) {
    if (now.traced == 0) return now.samples + 1;
    const double fit = (*limits.seconds - now.seconds) / (now.seconds / now.traced);
    return now.samples + static_cast<std::uint32_t>(std::clamp<double>(fit, 0, now.samples));
}

/// lightOf(i), varianceOf(i): luminance of pixel i and the variance of its mean; all pixels must have 2 samples or
/// more.
template <typename LightOf, typename VarianceOf>
double noiseOf(std::size_t pixels, const LightOf& lightOf, const VarianceOf& varianceOf) {
    double total = 0, sum = 0;
    for (std::size_t i = 0; i < pixels; ++i)
        if (const double light = lightOf(i); std::isfinite(light)) total += light;
    const double floor = kDarkest * (total / static_cast<double>(pixels));
    for (std::size_t i = 0; i < pixels; ++i) {
        const double light = lightOf(i) + floor, variance = varianceOf(i), share = variance / (light * light);
        if (variance > 0 && std::isfinite(share)) sum += share;
    }
    return std::sqrt(sum / static_cast<double>(std::max<std::size_t>(pixels, 1)));
}

bool hasFewSamples(const Film& film) {
    return std::any_of(film.samples.begin(), film.samples.end(), [](float samples) { return samples < 2; });
}

} // namespace

std::uint32_t nextCheck(const FrameLimits& limits, bool progressive, std::uint32_t most, const FrameState& now) {
    if (now.samples >= most) return now.samples;
    std::uint32_t next = most;
    if (progressive) next = std::min(next, std::max(2 * now.samples, 1u));
    if (limits.noise) next = std::min(next, nextNoiseCheck(limits, now));
    if (limits.seconds) next = std::min(next, nextTimeCheck(limits, now));
    return next;
}

double shareDone(const FrameLimits& limits, std::uint32_t most, const FrameState& now) {
    double share = now.mean / most;
    if (limits.seconds) share = std::max(share, now.seconds / *limits.seconds);
    if (limits.noise && now.noise) share = std::max(share, now.mean / samplesForNoise(limits, now));
    return std::min(share, 1.0);
}

bool judgesNoise(const FrameState& now) { return now.samples >= kFirstNoise; }

double relativeNoise(const Film& film) {
    if (hasFewSamples(film)) return std::numeric_limits<double>::infinity();
    return noiseOf(
        film.variance.size(), [&](std::size_t i) { return luminanceOf(film.rgba.data() + 4 * i); },
        [&](std::size_t i) { return film.variance[i]; });
}

NoiseMeter::NoiseMeter(std::size_t pixels) {
    lights_.reserve(pixels);
    variances_.reserve(pixels);
}

void NoiseMeter::addRows(const Film& rows) {
    unknown_ = unknown_ || hasFewSamples(rows);
    if (unknown_) return; // the noise stays unknown, so nothing is stored
    for (std::size_t i = 0; i < rows.variance.size(); ++i)
        lights_.push_back(static_cast<float>(luminanceOf(rows.rgba.data() + 4 * i)));
    variances_.insert(variances_.end(), rows.variance.begin(), rows.variance.end());
}

double NoiseMeter::noise() const {
    if (unknown_) return std::numeric_limits<double>::infinity();
    return noiseOf(
        lights_.size(), [&](std::size_t i) { return lights_[i]; }, [&](std::size_t i) { return variances_[i]; });
}

} // namespace pointrt
