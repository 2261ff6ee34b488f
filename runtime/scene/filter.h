// SPDX-License-Identifier: Apache-2.0
// Filters show only the splats of scans whose attributes have certain values. Rays pass through the others.
#pragma once

#include <string>
#include <vector>

#include "runtime/scene/value_range.h"

namespace pointrt {

/// Selects the splats whose value of the attribute lies in any of the ranges, ends included.
struct SplatSelection {
    std::string attribute;          ///< as RenderSettings::color_by, without rgb and normal
    std::vector<ValueRange> ranges; ///< empty for a filter that hides nothing yet
    bool operator==(const SplatSelection&) const = default;
};

/// Shows only the selected splats. Scans without the attribute, and Gaussians, are shown in full.
struct FilterDescription {
    SplatSelection shown;
    bool enabled = true;
    std::string place; ///< of the filter in the scene file, or the option; begins messages
    bool operator==(const FilterDescription&) const = default;
};

/// Whether a number is in any of the ranges; NaN, for a missing number, is in none.
bool holdsNumber(const std::vector<ValueRange>& ranges, double number);

/// "NAME=NUMBER,NUMBER..." or "NAME=FROM:TO". Throws std::invalid_argument.
FilterDescription parseFilter(const std::string& text);

/// Whether the filter is enabled and has ranges.
bool hidesSplats(const FilterDescription& filter);
/// Whether any of the filters hides splats.
bool hidesSplats(const std::vector<FilterDescription>& filters);

} // namespace pointrt
