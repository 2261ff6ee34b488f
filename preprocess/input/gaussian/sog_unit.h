// SPDX-License-Identifier: GPL-3.0-or-later
// The Gaussians of one meta.json of a SOG with its images.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "preprocess/input/gaussian/gaussians.h"
#include "preprocess/input/gaussian/sog_files.h"
#include "preprocess/input/gaussian/sog_meta.h"

namespace pointrt {

/// Four bytes for each pixel: red, green, blue, alpha.
struct SogImage {
    InputFile file;
    std::uint64_t width = 0, height = 0;
    std::vector<std::uint8_t> pixels; ///< once decoded

    std::uint64_t pixelCount() const { return width * height; }
    const std::uint8_t* at(std::uint64_t pixel) const { return pixels.data() + 4 * pixel; }
};

class SogUnit {
public:
    /// Opens the images and checks that they are large enough for the Gaussians that the meta.json promises, and not
    /// much larger. Decodes nothing. Throws Error.
    /// @param meta_file as it was opened
    /// @param folder of the images, relative to that of files.meta()
    SogUnit(const SogFiles& files, const InputFile& meta_file, const std::string& folder);

    std::uint64_t count() const { return meta_.count; }
    int degree() const { return degree_; } ///< of the harmonics

    /// Decodes the images. Throws Error if one is invalid or truncated.
    void decode();
    /// Requires decode(). index: below count()
    Gaussian at(std::uint64_t index) const;

private:
    void openImages(const SogFiles& files, const std::string& folder);
    void checkImages() const;
    void checkHarmonics();
    void readHarmonicsOf(std::uint64_t index, Gaussian& gaussian) const;

    SogMeta meta_;
    int degree_ = 0;
    SogImage means_low_, means_high_, quats_, scales_, colors_, centroids_, labels_;
};

} // namespace pointrt
