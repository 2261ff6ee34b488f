// SPDX-License-Identifier: Apache-2.0
#include "runtime/scene/setting_limits.h"

namespace pointrt {

std::string limitsText(CountRange range) { return std::to_string(range.low) + " to " + std::to_string(range.high); }
std::string limitsText(RealRange range) { return plainText(range.low) + " to " + plainText(range.high); }
std::string limitsText(SizeRange range) { return "1 to " + std::to_string(range.longest); }

std::string valueText(CountRange, std::uint32_t value) { return std::to_string(value); }
std::string valueText(RealRange, float value) { return plainText(value); }
std::string valueText(SizeRange, PixelSize value) {
    return std::to_string(value.width) + "x" + std::to_string(value.height);
}

std::uint32_t parseValue(CountRange range, const std::string& text) { return parseCount(text, range.low, range.high); }
float parseValue(RealRange range, const std::string& text) {
    return static_cast<float>(parseReal(text, range.low, range.high));
}
PixelSize parseValue(SizeRange range, const std::string& text) { return parseSize(text, range.longest); }

} // namespace pointrt
