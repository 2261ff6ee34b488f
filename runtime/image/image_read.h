// SPDX-License-Identifier: Apache-2.0
// Pictures of light from files: Radiance .hdr and OpenEXR.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace pointrt {

/// Row-major, y down; 3 floats a pixel, linear red, green, blue.
struct FloatImage {
    std::uint32_t width = 0, height = 0;
    std::vector<float> rgb;
};

/// A Radiance RGBE picture (-Y +X; its EXPOSURE is ignored, as most programs do) or an OpenEXR file with R, G and B or
/// Y alone (what is taken: checkExr), told by content; at most 16384 pixels a side. All values are finite and not
/// negative: NaN and negative ones become 0, infinity the largest 16-bit float, and none is above 1e9.
/// A picture may take pictureRoom of its file's size. Throws Error kBadInput "PATH: reason".
FloatImage readFloatImage(const std::string& path);

} // namespace pointrt
