// SPDX-License-Identifier: Apache-2.0
#include "runtime/window/platform/upscale.h"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace pointrt {
namespace {

/// A pixel with 16 bits per channel, so that one multiplication scales all four.
using WidePixel = std::uint64_t;
constexpr WidePixel kChannels = 0x00ff00ff00ff00ff;

WidePixel widen(std::uint32_t pixel) {
    const WidePixel halves = (pixel | static_cast<WidePixel>(pixel) << 16) & 0x0000ffff0000ffff;
    return (halves | halves << 8) & kChannels;
}

std::uint32_t narrow(WidePixel wide) {
    const WidePixel halves = (wide | wide >> 8) & 0x0000ffff0000ffff;
    return static_cast<std::uint32_t>(halves | halves >> 16);
}

/// Linear interpolation in units of 1/256. Sums stay below 2^16: 255 * 256 + 128.
WidePixel blend(WidePixel a, WidePixel b, std::uint32_t share) {
    constexpr WidePixel kHalf = 0x0080008000800080;
    return (a * (256 - share) + b * share + kHalf) >> 8 & kChannels;
}

/// The two input pixels of an output pixel along an axis, and the weight of the second.
struct Tap {
    std::uint32_t first, second, share;
};

std::vector<Tap> tapsFor(std::uint32_t from, std::uint32_t to) {
    std::vector<Tap> taps(to);
    for (std::uint32_t i = 0; i < to; ++i) {
        const double centre = (i + 0.5) * from / to - 0.5;
        const double position = std::clamp(centre, 0.0, static_cast<double>(from - 1));
        const auto first = static_cast<std::uint32_t>(position);
        const auto share = static_cast<std::uint32_t>((position - first) * 256 + 0.5);
        taps[i] = {first, std::min(first + 1, from - 1), share};
    }
    return taps;
}

} // namespace

void upscale(const std::uint32_t* from, PixelGrid from_size, std::uint32_t* to, PixelGrid to_size) {
    const std::vector<Tap> columns = tapsFor(from_size.width, to_size.width);
    std::vector<WidePixel> row(from_size.width);
    for (const Tap& tap : tapsFor(from_size.height, to_size.height)) {
        const std::uint32_t* upper = from + static_cast<std::size_t>(tap.first) * from_size.width;
        const std::uint32_t* lower = from + static_cast<std::size_t>(tap.second) * from_size.width;
        for (std::uint32_t x = 0; x < from_size.width; ++x) row[x] = blend(widen(upper[x]), widen(lower[x]), tap.share);
        for (const Tap& column : columns) *to++ = narrow(blend(row[column.first], row[column.second], column.share));
    }
}

} // namespace pointrt
