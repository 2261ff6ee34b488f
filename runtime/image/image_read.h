// SPDX-License-Identifier: Apache-2.0
// Reads HDR pictures: Radiance .hdr and OpenEXR.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace pointrt {

/// Row-major, y down; 3 floats per pixel: linear red, green, blue.
struct FloatImage {
    std::uint32_t width = 0, height = 0;
    std::vector<float> rgb;
};

/// Reads a Radiance RGBE picture (-Y +X; EXPOSURE is ignored, as in most programs) or an OpenEXR file with R, G and B,
/// or Y only (see checkExr), recognised by content, of at most 16384 pixels a side. Values are made finite and not
/// negative: NaN and negative values become 0, infinity becomes the largest 16-bit float, others are clamped to 1e9.
/// Throws Error kBadInput "PATH: reason", also if the picture exceeds the pictureRoom of its file.
FloatImage readFloatImage(const std::string& path);

} // namespace pointrt
