// SPDX-License-Identifier: Apache-2.0
// Filters show the splats of scans whose attributes have certain values. Rays pass the others as if they were not
// there.
#pragma once

#include <string>
#include <vector>

#include "runtime/scene/value_range.h"

namespace pointrt {

/// Numbers of splats: all that lie in any of the ranges, ends included.
struct SplatSelection {
    std::string attribute;          ///< as RenderSettings::color_by, without rgb and normal
    std::vector<ValueRange> ranges; ///< of a filter: none while nothing is hidden yet
    bool operator==(const SplatSelection&) const = default;
};

/// Shows only the selected splats. Scans without the attribute, and Gaussians, stay whole.
struct FilterDescription {
    SplatSelection shown;
    bool enabled = true;
    std::string place; ///< in the scene file, or the option, to start messages with
    bool operator==(const FilterDescription&) const = default;
};

/// Whether a number is in any of the ranges; NaN, for missing numbers, is in none.
bool holdsNumber(const std::vector<ValueRange>& ranges, double number);

/// "NAME=NUMBER,NUMBER..." or "NAME=FROM:TO". Throws std::invalid_argument.
FilterDescription parseFilter(const std::string& text);

/// Whether it is enabled and has ranges.
bool hidesSplats(const FilterDescription& filter);
/// Whether any does.
bool hidesSplats(const std::vector<FilterDescription>& filters);

} // namespace pointrt
