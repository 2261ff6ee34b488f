// SPDX-License-Identifier: GPL-3.0-or-later
// Colours of a scan, scaled to 8 bits once their largest value is known.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "preprocess/ingest/columns.h"
#include "preprocess/ingest/dimensions.h"
#include "preprocess/ingest/scan_traits.h"

namespace pointrt {

/// Colour of points without one in a cloud with colours.
inline constexpr Rgb8 kGreyColor = {200, 200, 200};

using Rgb16 = std::array<std::uint16_t, 3>;

class ScanColors {
public:
    /// Starts a scan. beginColumns() must have been called with its traits.
    void begin(const ScanTraits& traits, const Columns& columns, const Cloud& cloud);

    /// Adds the colour of a vertex. Bytes go to the cloud at once; other values wait until scale() is called.
    void add(Cloud& cloud, const Row& row, const char* values);
    /// Adds 16-bit colours of many vertices. kept: indices of the vertices to keep
    void addColumn(std::span<const char* const> columns, std::span<const std::uint32_t> kept);

    /// Whether colours wait for scale().
    bool waits() const { return has_colors_ && scale_ != ColorScale::kByte; }
    bool is16Bit() const { return scale_ == ColorScale::k16Bit; }
    /// The largest finite value so far, at least 0. first_position: index of the scan's first point
    float largest(const Cloud& cloud, std::size_t first_position) const;
    /// Appends the waiting colours to the cloud.
    /// @param largest value of all colours of the scan; no 16-bit colour is appended if it is 0
    void scale(Cloud& cloud, std::size_t first_position, float largest);
    /// Drops the waiting colours.
    void clear();

private:
    bool has_colors_ = false;
    ColorScale scale_ = ColorScale::kByte;
    std::optional<ColumnPlace> rgb16_column_;
    std::optional<std::size_t> rgb16_attribute_;    ///< index in the cloud, if it keeps the 16-bit colours unchanged
    std::vector<Rgb16> rgb16_;                      ///< of kept vertices, if no attribute keeps them
    std::vector<std::array<float, 3>> wide_colors_; ///< of kept vertices: kInteger and kReal

    void scale16Bit(Cloud& cloud, std::size_t first_position, float largest);
    void scaleWide(Cloud& cloud, float largest);
};

} // namespace pointrt
