// SPDX-License-Identifier: Apache-2.0
// Pictures of floats, and PFM files (Debevec's Portable FloatMap).
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace pointrt::test {

/// Row-major pixels, y down.
struct FloatPicture {
    std::uint32_t width = 0, height = 0;
    std::uint32_t channels = 3; ///< 1 or 3
    std::vector<float> values;
};

/// Little-endian. Files store the bottom row first. Both throw std::runtime_error "PATH: reason".
void writePfm(const std::string& path, const FloatPicture& picture);
FloatPicture readPfm(const std::string& path);

} // namespace pointrt::test
