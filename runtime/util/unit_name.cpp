// SPDX-License-Identifier: Apache-2.0
#include "runtime/util/unit_name.h"

#include <cmath>

namespace pointrt {

std::string unitName(double metres) {
    struct Unit {
        const char* name;
        double metres;
    };
    constexpr Unit kUnits[] = {{"m", 1}, {"ft", 0.3048}, {"ftUS", 1200.0 / 3937}, {"cm", 0.01}, {"mm", 0.001}};
    constexpr double kSame = 1e-9; // relative; the international foot and the US survey foot differ by 2e-6
    for (const Unit& unit : kUnits)
        if (std::abs(metres / unit.metres - 1) < kSame) return unit.name;
    return {};
}

} // namespace pointrt
