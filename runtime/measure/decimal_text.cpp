// SPDX-License-Identifier: Apache-2.0
#include "runtime/measure/decimal_text.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

namespace pointrt {

std::string decimalText(double value, int decimals) {
    std::array<char, 400> text{}; // a double has up to 309 digits before the point
    std::snprintf(text.data(), text.size(), "%.*f", decimals, value);
    const std::string number = text.data();
    return number.find_first_not_of("-0.") == number.npos && number[0] == '-' ? number.substr(1) : number; // no -0.0
}

int decimalsOf(double step) {
    if (!(step > 0) || !std::isfinite(step)) return 3;
    return static_cast<int>(std::clamp(std::ceil(-std::log10(step)), 0.0, 9.0));
}

double roundBelow(double limit) {
    const double power = std::pow(10, std::floor(std::log10(limit)));
    return power * (limit >= 5 * power ? 5 : limit >= 2 * power ? 2 : 1);
}

double roundAbove(double limit) {
    const double power = std::pow(10, std::floor(std::log10(limit)));
    for (const double times : {1, 2, 5})
        if (times * power >= limit) return times * power;
    return 10 * power;
}

} // namespace pointrt
