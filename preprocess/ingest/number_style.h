// SPDX-License-Identifier: GPL-3.0-or-later
// Numbers as programs for people write them: with decimal points or commas, and separators between thousands.
#pragma once

#include <optional>
#include <span>
#include <string_view>

namespace pointrt {

struct NumberStyle {
    char decimal = '.';
    std::string_view group = {}; ///< between groups of three digits; empty: none

    bool isPlain() const { return decimal == '.' && group.empty(); }
};

/// All styles, plainer ones first.
std::span<const NumberStyle> numberStyles();

/// Whether a field is a number in a style. Digits need not be grouped.
bool styledNumber(std::string_view field, const NumberStyle& style, double& value);

/// Whether a field is a number in any style.
bool isAnyNumber(std::string_view field);

/// The styles that all numbers added so far fit.
class NumberSurvey {
public:
    /// Ignores fields that are numbers in no style.
    void add(std::string_view field);

    /// The plainest style that fits all numbers; if none does, the one that fits the first numbers.
    NumberStyle style() const;
    /// Whether commas may separate decimals or thousands: each is before three digits.
    bool isAmbiguous() const;

private:
    bool fits(std::size_t style) const { return (fitting_ >> style & 1) != 0; }

    unsigned fitting_ = ~0u; ///< a bit for each style
};

} // namespace pointrt
