// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/ingest/number_style.h"

#include <array>
#include <string>

#include "preprocess/ingest/text.h"

namespace pointrt {
namespace {

constexpr std::string_view kNoBreakSpace = "\xc2\xa0", kNarrowSpace = "\xe2\x80\xaf", kRightQuote = "\xe2\x80\x99";
constexpr std::array kStyles = {NumberStyle{'.', {}},
                                NumberStyle{',', {}},
                                NumberStyle{'.', ","},
                                NumberStyle{'.', "'"},
                                NumberStyle{'.', kRightQuote},
                                NumberStyle{'.', " "},
                                NumberStyle{'.', kNoBreakSpace},
                                NumberStyle{'.', kNarrowSpace},
                                NumberStyle{',', "."},
                                NumberStyle{',', "'"},
                                NumberStyle{',', kRightQuote},
                                NumberStyle{',', " "},
                                NumberStyle{',', kNoBreakSpace},
                                NumberStyle{',', kNarrowSpace}};
constexpr std::size_t kDecimalComma = 1, kCommaGroups = 2; // their places among the styles

bool isDigit(char letter) { return letter >= '0' && letter <= '9'; }

/// Builds the plain form of a number piece by piece.
struct PlainNumber {
    std::string text;
    std::size_t digits = 0; ///< of the current group
    bool grouped = false, has_decimals = false;

    /// Whether a group of digits may end here: 1 to 3 digits without a leading zero for the first group, then 3 each.
    bool endsGroup() const { return grouped ? digits == 3 : digits >= 1 && digits <= 3 && !startsWithZero(); }
    bool startsWithZero() const { return text[text.size() - digits] == '0'; }

    bool separate() {
        if (has_decimals || !endsGroup()) return false;
        grouped = true;
        digits = 0;
        return true;
    }
    bool startDecimals() {
        if (has_decimals || (grouped && digits != 3)) return false;
        has_decimals = true;
        text += '.';
        return true;
    }
    bool add(char letter) {
        if (letter == '.' || letter == ',') return false; // the sign of another style
        digits += isDigit(letter) && !has_decimals;
        text += letter;
        return true;
    }
    bool isWhole() const { return has_decimals || !grouped || digits == 3; }
};

/// Whether a field may be a number: it starts with a digit, a sign or a decimal point, and ends with a digit.
bool looksLikeNumber(std::string_view field) {
    constexpr std::size_t kLongest = 64; // three times the digits of a double, with separators
    if (field.empty() || field.size() > kLongest || !isDigit(field.back())) return false;
    return isDigit(field.front()) || std::string_view("+-.,").find(field.front()) != std::string_view::npos;
}

} // namespace

std::span<const NumberStyle> numberStyles() { return kStyles; }

bool styledNumber(std::string_view field, const NumberStyle& style, double& value) {
    if (style.isPlain() || !looksLikeNumber(field)) return style.isPlain() && wholeNumber(field, value);
    PlainNumber plain;
    while (!field.empty()) {
        const bool separates = !style.group.empty() && field.starts_with(style.group);
        const bool fits = separates                        ? plain.separate()
                          : field.front() == style.decimal ? plain.startDecimals()
                                                           : plain.add(field.front());
        if (!fits) return false;
        field.remove_prefix(separates ? style.group.size() : 1);
    }
    return plain.isWhole() && wholeNumber(plain.text, value);
}

bool isAnyNumber(std::string_view field) {
    double value = 0;
    if (wholeNumber(field, value)) return true;
    for (const NumberStyle& style : kStyles)
        if (styledNumber(field, style, value)) return true;
    return false;
}

void NumberSurvey::add(std::string_view field) {
    unsigned fitting = 0;
    double value = 0;
    for (std::size_t i = 0; i < kStyles.size(); ++i)
        if (styledNumber(field, kStyles[i], value)) fitting |= 1u << i;
    if ((fitting & fitting_) != 0) fitting_ &= fitting;
}

NumberStyle NumberSurvey::style() const {
    for (std::size_t i = 0; i < kStyles.size(); ++i)
        if (fits(i)) return kStyles[i];
    return {};
}

bool NumberSurvey::isAmbiguous() const { return !fits(0) && fits(kDecimalComma) && fits(kCommaGroups); }

} // namespace pointrt
