// SPDX-License-Identifier: GPL-3.0-or-later
// The meta.json of a SOG: how the bytes of its images encode Gaussians.
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "preprocess/cloud/cloud.h"
#include "preprocess/ingest/input_file.h"

namespace pointrt {

/// A value for each byte.
using ByteTable = std::array<float, 256>;

/// Names of the images; those of harmonics are "" in captures without harmonics.
struct SogImageNames {
    std::string means_low, means_high, quats, scales, colors, centroids, labels;
};

struct SogMeta {
    std::uint64_t count = 0;
    Vec3d low = Vec3d::Zero(), high = Vec3d::Zero(); ///< of the logarithms of the means
    std::array<ByteTable, 3> scales{};               ///< by axis: logarithms of the deviations
    std::array<ByteTable, 3> colors{};               ///< by channel: factors of the constant harmonic
    ByteTable opacities{};
    ByteTable harmonics{};     ///< factors, of all channels
    int degree = 0;            ///< of the harmonics, if the file says so: 0 to 3
    std::uint64_t palette = 0; ///< number of sets of harmonics; 0: as many as its image holds
    SogImageNames images;

    bool hasHarmonics() const { return !images.centroids.empty(); }
};

/// Parses version 1, whose bytes are shares of a range, or version 2, whose bytes are indices of a codebook. Throws
/// Error if a member is missing or invalid, or for another version.
SogMeta parseSogMeta(const InputFile& input);

} // namespace pointrt
