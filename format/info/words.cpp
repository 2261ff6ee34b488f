// SPDX-License-Identifier: Apache-2.0
#include "format/info/words.h"

#include <fmt/format.h>

#include <cmath>
#include <iterator>

namespace pointrt {

std::string humanBytes(std::uint64_t bytes) {
    constexpr const char* kUnits[] = {"B", "KiB", "MiB", "GiB", "TiB"};
    auto value = static_cast<double>(bytes);
    std::size_t unit = 0;
    for (; value >= 1024 && unit + 1 < std::size(kUnits); ++unit) value /= 1024;
    return unit == 0 ? fmt::format("{} B", bytes) : fmt::format("{:.1f} {} ({} bytes)", value, kUnits[unit], bytes);
}

std::string vectorText(const double v[3]) { return fmt::format("({:.10g}, {:.10g}, {:.10g})", v[0], v[1], v[2]); }

std::string upText(const pro_world& world) {
    if (world.up[0] == 0 && world.up[1] == 0 && world.up[2] == 0) return "not known";
    for (int axis = 0; axis < 3; ++axis)
        if (std::abs(world.up[axis]) == 1) return fmt::format("{}{}", world.up[axis] < 0 ? "-" : "", "xyz"[axis]);
    return fmt::format("({:.6g}, {:.6g}, {:.6g})", world.up[0], world.up[1], world.up[2]);
}

std::string unitText(const pro_world& world) {
    return world.metres_per_unit == 0 ? "not known" : fmt::format("{:.10g} m", world.metres_per_unit);
}

} // namespace pointrt
