// SPDX-License-Identifier: Apache-2.0
// Limits that end a frame: noise, time, samples.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "runtime/image/film.h"

namespace pointrt {

constexpr double kTimeOverrun_s = 1;

/// Limits that may end a frame before it has all its samples.
struct FrameLimits {
    /// No sample starts that is predicted, from the earlier ones, to end later; a sample that overruns by
    /// kTimeOverrun_s is aborted.
    std::optional<double> seconds;
    std::optional<double> noise; ///< ends when relativeNoise is at or below this
};

/// Progress of a frame.
struct FrameState {
    std::uint32_t samples = 0;    ///< the fewest of any pixel
    double seconds = 0;           ///< since this run started
    double mean = 0;              ///< samples per pixel, averaged over the picture
    double traced = 0;            ///< the part of mean that this run added
    std::uint32_t empty_rows = 0; ///< rows without samples
    std::optional<double> noise;  ///< at the last check, at noise_samples
    std::uint32_t noise_samples = 0;
};

/// Samples per pixel after which to check noise and time again; now.samples if the frame is done. Checks come at
/// doubling counts, sooner if a limit is near. This keeps checks few, and the sample counts of a large image's bands,
/// each rendered up to the next check, within a factor of 2 of each other. progressive: check even without limits, so
/// that an interrupted frame has samples everywhere.
std::uint32_t nextCheck(const FrameLimits& limits, bool progressive, std::uint32_t most, const FrameState& now);

/// Progress in [0, 1], by the limit that is closest to being reached: samples, time, or noise, which falls as 1 /
/// sqrt(samples).
double shareDone(const FrameLimits& limits, std::uint32_t most, const FrameState& now);

/// Whether there are enough samples to estimate noise: with fewer, too many pixels have missed rare bright paths.
bool judgesNoise(const FrameState& now);

/// Root mean square over the pixels of the standard error of the luminance over (luminance + 1% of the picture's mean
/// luminance), from film.variance: the square root of the relative mean squared error of Rousselle, Knaus and Zwicker,
/// Adaptive Sampling and Reconstruction using Greedy Error Minimization, 2011, with the true error estimated. Each
/// pixel contributes at most 1, so a few fireflies do not dominate. Samples are assumed independent; as they are
/// stratified, this overestimates the noise. Infinite if a pixel has fewer than 2 samples.
double relativeNoise(const Film& film);

constexpr std::uint64_t kNoiseBytes = 2 * sizeof(float);

/// relativeNoise of a picture whose rows are added one after the other. Stores kNoiseBytes per pixel.
class NoiseMeter {
public:
    explicit NoiseMeter(std::size_t pixels);
    void addRows(const Film& rows);
    /// The noise of all rows added so far.
    double noise() const;

private:
    std::vector<float> lights_, variances_;
    bool unknown_ = false;
};

} // namespace pointrt
