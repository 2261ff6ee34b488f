// SPDX-License-Identifier: Apache-2.0
// When a frame is good enough, or has taken long enough.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "runtime/image/film.h"

namespace pointrt {

constexpr double kTimeOverrun_s = 1;

/// What may end a frame before it has all its samples.
struct FrameLimits {
    /// No sample begins that, going by those before, would end later; one that goes on for kTimeOverrun_s more is
    /// broken off.
    std::optional<double> seconds;
    std::optional<double> noise; ///< relativeNoise is at or below this
};

/// How far a frame is.
struct FrameState {
    std::uint32_t samples = 0;    ///< the fewest of any pixel
    double seconds = 0;           ///< since this run of it began
    double mean = 0;              ///< samples a pixel, the mean over pixels ...
    double traced = 0;            ///< ... and what this run has added to it
    std::uint32_t empty_rows = 0; ///< that have none
    std::optional<double> noise;  ///< at the last look, which was at noise_samples
    std::uint32_t noise_samples = 0;
};

/// Samples a pixel after which to look at the picture and the clock again; now.samples where the frame is done.
/// Looks come at doubling counts, sooner where time or noise are about to run out: so they are few, and the bands of a
/// large image, rendered one after the other up to each look, stay within a factor of 2 of each other.
/// progressive: look though there are no limits, so that a frame that is broken off has something everywhere.
std::uint32_t nextLook(const FrameLimits& limits, bool progressive, std::uint32_t most, const FrameState& now);

/// Share of the frame that is done, in [0, 1]: by samples, time or noise, which falls as 1 / sqrt(samples).
double shareDone(const FrameLimits& limits, std::uint32_t most, const FrameState& now);

/// True where the noise can be judged: with fewer samples too many pixels have not met what is rare.
bool judgesNoise(const FrameState& now);

/// Root mean square over the pixels of the standard error of the luminance over (luminance + 1% of the picture's mean
/// luminance), from film.variance: the square root of the relative mean squared error of Rousselle, Knaus and Zwicker,
/// Adaptive Sampling and Reconstruction using Greedy Error Minimization, 2011, with the true error estimated. No pixel
/// counts for more than 1, so a few fireflies do not rule it; samples are taken as independent, and since they are
/// spread more evenly than that, it is rather too high. Infinite where a pixel has fewer than 2 samples.
double relativeNoise(const Film& film);

constexpr std::uint64_t kNoiseBytes = 2 * sizeof(float);

/// relativeNoise of a picture of so many pixels whose rows come one after the other. It keeps kNoiseBytes of each.
class NoiseMeter {
public:
    explicit NoiseMeter(std::size_t pixels);
    void addRows(const Film& rows);
    /// Of all rows there were.
    double noise() const;

private:
    std::vector<float> lights_, variances_;
    bool unknown_ = false;
};

} // namespace pointrt
