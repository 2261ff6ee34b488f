// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/ingest/scan_colors.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace pointrt {
namespace {

std::uint8_t toByte(double value) {
    if (!(value > 0)) return 0;
    return value < 255 ? static_cast<std::uint8_t>(value + 0.5) : std::uint8_t{255};
}

/// The upper 8 of 16 bits, as a shift would give them.
std::uint8_t upperByte(float value) { return toByte(std::floor(value / 256.0)); }

Rgb8 toBytes(const Row& row) { return {toByte(row[kRed]), toByte(row[kGreen]), toByte(row[kBlue])}; }

float largestOf(const std::vector<std::array<float, 3>>& colors) {
    float largest = 0;
    for (const auto& color : colors)
        for (const float value : color)
            if (std::isfinite(value)) largest = std::max(largest, value);
    return largest;
}

/// The attribute that keeps a column of 16-bit colours as it is.
std::optional<std::size_t> rgb16Attribute(const Columns& columns, const Cloud& cloud) {
    std::optional<std::size_t> found;
    for (const Columns::Column& column : columns.selected) {
        const Attribute& attribute = cloud.attributes[column.attribute];
        if (attribute.name == kRgb16 && column.type == Scalar::kU16 && attribute.type == Scalar::kU16)
            found = column.attribute;
    }
    return found;
}

/// 16-bit colours, which need not be aligned.
struct Colors16 {
    const char* first;
    std::size_t count;

    Rgb16 at(std::size_t i) const {
        Rgb16 color;
        std::memcpy(color.data(), first + i * sizeof color, sizeof color);
        return color;
    }

    std::uint16_t largest() const {
        std::uint16_t value = 0;
        for (std::size_t i = 0; i < count; ++i) {
            const Rgb16 color = at(i);
            value = std::max({value, color[0], color[1], color[2]});
        }
        return value;
    }
};

/// The 16-bit colours of the scan's points that the cloud holds: from the attribute or, without one, from `own`.
Colors16 colors16Of(const Cloud& cloud, std::size_t first_position, std::optional<std::size_t> attribute,
                    const std::vector<Rgb16>& own) {
    const char* const first = attribute ? cloud.attributes[*attribute].values.data() + first_position * sizeof(Rgb16)
                                        : reinterpret_cast<const char*>(own.data());
    return {first, cloud.positions.size() - first_position};
}

} // namespace

void ScanColors::begin(const ScanTraits& traits, const Columns& columns, const Cloud& cloud) {
    clear();
    has_colors_ = traits.colors;
    scale_ = traits.color_scale;
    rgb16_column_ = findColumn(traits, kRgb16);
    rgb16_attribute_ = rgb16Attribute(columns, cloud);
}

void ScanColors::clear() {
    wide_colors_.clear();
    rgb16_.clear();
}

void ScanColors::add(Cloud& cloud, const Row& row, const char* values) {
    switch (scale_) {
    case ColorScale::kByte:
        cloud.colors.push_back(toBytes(row));
        return;
    case ColorScale::k16Bit:
        if (!rgb16_attribute_)
            std::memcpy(rgb16_.emplace_back().data(), values + rgb16_column_->offset, sizeof rgb16_.back());
        return;
    default:
        wide_colors_.push_back(
            {static_cast<float>(row[kRed]), static_cast<float>(row[kGreen]), static_cast<float>(row[kBlue])});
    }
}

void ScanColors::addColumn(std::span<const char* const> columns, std::span<const std::uint32_t> kept) {
    if (!has_colors_ || rgb16_attribute_) return;
    const char* const column = columns[rgb16_column_->column];
    const std::size_t before = rgb16_.size();
    rgb16_.resize(before + kept.size());
    auto* to = rgb16_.data() + before;
    for (const std::uint32_t vertex : kept) std::memcpy(to++, column + vertex * sizeof *to, sizeof *to);
}

float ScanColors::largest(const Cloud& cloud, std::size_t first_position) const {
    return is16Bit() ? colors16Of(cloud, first_position, rgb16_attribute_, rgb16_).largest() : largestOf(wide_colors_);
}

void ScanColors::scale(Cloud& cloud, std::size_t first_position, float largest) {
    if (is16Bit())
        scale16Bit(cloud, first_position, largest);
    else
        scaleWide(cloud, largest);
}

void ScanColors::scale16Bit(Cloud& cloud, std::size_t first_position, float largest) {
    const Colors16 colors = colors16Of(cloud, first_position, rgb16_attribute_, rgb16_);
    const int shift = largest > 255 ? 8 : 0;
    const auto scaled = [shift](std::uint16_t value) { return static_cast<std::uint8_t>(value >> shift); };
    for (std::size_t i = 0; i < colors.count && largest > 0; ++i) {
        const Rgb16 color = colors.at(i);
        cloud.colors.push_back({scaled(color[0]), scaled(color[1]), scaled(color[2])});
    }
    rgb16_ = {};
}

void ScanColors::scaleWide(Cloud& cloud, float largest) {
    const bool in_unit_range = scale_ == ColorScale::kReal && largest <= 1;
    const bool wide = largest > 255;
    const auto scaled = [&](float value) {
        return in_unit_range ? toByte(255.0 * value) : wide ? upperByte(value) : toByte(value);
    };
    for (const auto& color : wide_colors_)
        cloud.colors.push_back({scaled(color[0]), scaled(color[1]), scaled(color[2])});
    wide_colors_ = {};
}

} // namespace pointrt
