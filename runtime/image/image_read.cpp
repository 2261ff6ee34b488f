// SPDX-License-Identifier: Apache-2.0
#include "runtime/image/image_read.h"

#include <cmath>
#include <vector>

#include "format/base/error.h"
#include "runtime/image/exr_read.h"
#include "runtime/image/radiance_read.h"
#include "runtime/util/input_file.h"

namespace pointrt {
namespace {

constexpr float kLargestHalf = 65504; // replaces values that overflowed in a 16-bit file
constexpr float kBrightest = 1e9f;    // more than the sun in candela per square metre; sums stay finite

float usable(float value) {
    if (!(value > 0)) return 0;
    return std::isinf(value) ? kLargestHalf : std::fmin(value, kBrightest);
}

FloatImage readExrColors(const std::string& path) {
    const ExrPicture picture = readExr(path, ExrKind::kPicture);
    const auto& planes = picture.floats;
    const bool grey = !planes.count("R") && planes.count("Y");
    const char* names[] = {grey ? "Y" : "R", grey ? "Y" : "G", grey ? "Y" : "B"};
    FloatImage image{picture.width, picture.height, {}};
    image.rgb.resize(std::size_t{3} * picture.width * picture.height);
    for (std::size_t c = 0; c < 3; ++c) {
        const auto plane = planes.find(names[c]);
        if (plane == planes.end()) throw Error{ExitCode::kBadInput, path + ": has no channels R, G and B"};
        for (std::size_t i = 0; i < plane->second.size(); ++i) image.rgb[3 * i + c] = plane->second[i];
    }
    return image;
}

} // namespace

FloatImage readFloatImage(const std::string& path) {
    const std::vector<std::uint8_t> start = readFileStart(path, 2);
    const auto startsWith = [&](std::uint8_t first, std::uint8_t second) {
        return start.size() == 2 && start[0] == first && start[1] == second;
    };
    const bool radiance = startsWith('#', '?'), exr = startsWith(0x76, 0x2f);
    if (!radiance && !exr) throw Error{ExitCode::kBadInput, path + ": neither a Radiance .hdr nor an OpenEXR picture"};
    FloatImage image = radiance ? readRadiance(path) : readExrColors(path);
    for (float& value : image.rgb) value = usable(value);
    return image;
}

} // namespace pointrt
