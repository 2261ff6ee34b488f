// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/tiles/merge_values.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <string_view>

#include "preprocess/cloud/srgb.h"

namespace pointrt {

namespace {

const std::array<double, 256>& linearOfBytes() {
    static const std::array<double, 256> table = [] {
        std::array<double, 256> values;
        for (std::size_t i = 0; i < values.size(); ++i) values[i] = linearFromSrgb(static_cast<double>(i) / 255);
        return values;
    }();
    return table;
}

const char* valueOf(const std::vector<SplatsView>& tiles, std::size_t attribute, const MergeSource& source) {
    const SplatsView::Values& values = tiles[source.tile].attributes[attribute];
    return values.data + source.splat * values.bytes_each;
}

/// The value that covers the largest area; the first one of equals.
void mergeCategorical(const std::vector<SplatsView>& tiles, std::size_t attribute, std::size_t bytes,
                      const MergeGroup& group, char* to) {
    float most = -1;
    for (std::size_t i = 0; i < group.members.size(); ++i) {
        const char* value = valueOf(tiles, attribute, group.members[i]);
        float area = 0;
        for (std::size_t j = 0; j < group.members.size(); ++j)
            if (std::memcmp(value, valueOf(tiles, attribute, group.members[j]), bytes) == 0) area += group.areas[j];
        if (area <= most) continue;
        most = area;
        std::memcpy(to, value, bytes);
    }
}

template <typename Number>
Number rounded(double value) {
    if constexpr (std::numeric_limits<Number>::is_integer) {
        constexpr double kLow = std::numeric_limits<Number>::min(), kHigh = std::numeric_limits<Number>::max();
        return static_cast<Number>(std::clamp(std::round(value), kLow, kHigh));
    }
    return static_cast<Number>(value);
}

template <typename Number>
void mergeNumber(const std::vector<SplatsView>& tiles, std::size_t attribute, std::size_t component, bool is_color,
                 const MergeGroup& group, char* to) {
    double sum = 0, areas = 0;
    for (std::size_t i = 0; i < group.members.size(); ++i) {
        Number number;
        std::memcpy(&number, valueOf(tiles, attribute, group.members[i]) + component * sizeof number, sizeof number);
        const auto value = static_cast<double>(number);
        if (!std::isfinite(value)) continue;
        sum += group.areas[i] * (is_color ? linearFromSrgb(value / 65535) : value);
        areas += group.areas[i];
    }
    const double mean = areas > 0 ? sum / areas : std::numeric_limits<double>::quiet_NaN();
    const Number merged = rounded<Number>(is_color ? 65535 * srgbFromLinear(mean) : mean);
    std::memcpy(to + component * sizeof merged, &merged, sizeof merged);
}

using MergeNumber = decltype(&mergeNumber<float>);

MergeNumber mergerOf(Scalar type) {
    switch (type) {
    case Scalar::kI8:
        return mergeNumber<std::int8_t>;
    case Scalar::kU8:
        return mergeNumber<std::uint8_t>;
    case Scalar::kI16:
        return mergeNumber<std::int16_t>;
    case Scalar::kU16:
        return mergeNumber<std::uint16_t>;
    case Scalar::kI32:
        return mergeNumber<std::int32_t>;
    case Scalar::kU32:
        return mergeNumber<std::uint32_t>;
    case Scalar::kF32:
        return mergeNumber<float>;
    case Scalar::kF64:
        return mergeNumber<double>;
    case Scalar::kI64:
    case Scalar::kU64:
        break; // categorical: not averaged
    }
    return nullptr;
}

} // namespace

Rgb8 meanColor(const std::vector<SplatsView>& tiles, const MergeGroup& group) {
    std::array<double, 3> sums{};
    double areas = 0;
    for (std::size_t i = 0; i < group.members.size(); ++i) {
        const Rgb8& color = tiles[group.members[i].tile].colors[group.members[i].splat];
        for (std::size_t c = 0; c < 3; ++c) sums[c] += group.areas[i] * linearOfBytes()[color[c]];
        areas += group.areas[i];
    }
    Rgb8 mean;
    for (std::size_t c = 0; c < 3; ++c)
        mean[c] = static_cast<std::uint8_t>(std::lround(255 * srgbFromLinear(sums[c] / areas)));
    return mean;
}

float meanNoise(const std::vector<SplatsView>& tiles, const MergeGroup& group) {
    double sum = 0, areas = 0;
    for (std::size_t i = 0; i < group.members.size(); ++i) {
        const auto& noise = tiles[group.members[i].tile].noise;
        const double sigma = noise.empty() ? 0 : noise[group.members[i].splat];
        sum += group.areas[i] * sigma * sigma;
        areas += group.areas[i];
    }
    return static_cast<float>(std::sqrt(sum / areas));
}

bool isCategorical(const Attribute& attribute) {
    constexpr std::string_view kNames[] = {"classification",
                                           "return_number",
                                           "number_of_returns",
                                           "scan_direction_flag",
                                           "edge_of_flight_line",
                                           "synthetic",
                                           "key_point",
                                           "withheld",
                                           "overlap",
                                           "scanner_channel",
                                           "user_data",
                                           "point_source_id",
                                           "scan",
                                           "row",
                                           "column"};
    if (attribute.type == Scalar::kI64 || attribute.type == Scalar::kU64) return true;
    return std::find(std::begin(kNames), std::end(kNames), attribute.name) != std::end(kNames);
}

void mergeValue(const std::vector<SplatsView>& tiles, std::size_t attribute, const Attribute& schema,
                const MergeGroup& group, char* to) {
    if (isCategorical(schema)) return mergeCategorical(tiles, attribute, schema.bytesEach(), group, to);
    const bool is_color = schema.name == kRgb16 && schema.type == Scalar::kU16;
    const MergeNumber merge = mergerOf(schema.type);
    for (std::size_t component = 0; component < schema.components; ++component)
        merge(tiles, attribute, component, is_color, group, to);
}

} // namespace pointrt
