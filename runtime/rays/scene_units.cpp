// SPDX-License-Identifier: Apache-2.0
#include "runtime/rays/scene_units.h"

#include <cmath>

#include "format/crs/epsg_code.h"
#include "runtime/measure/decimal_text.h"
#include "runtime/rays/scene_points.h"
#include "runtime/studies/scene_world.h"

namespace pointrt {
namespace {

std::string unitName(double metres) {
    struct Unit {
        const char* name;
        double metres;
    };
    // the international foot, and that of the US surveys before 2023
    constexpr Unit kUnits[] = {{"m", 1}, {"ft", 0.3048}, {"ftUS", 1200.0 / 3937}, {"cm", 0.01}, {"mm", 0.001}};
    constexpr double kSame = 1e-9; // the two feet differ by 2e-6
    for (const Unit& unit : kUnits)
        if (std::abs(metres / unit.metres - 1) < kSame) return unit.name;
    return {};
}

} // namespace

SceneUnits sceneUnits(const std::vector<std::string>& paths) {
    const PointOutline outline = sceneOutline(paths);
    const SceneWorld world = sceneWorld(paths.front());
    const int epsg = world.placement == Placement{} ? epsgCode(world.crs) : 0;
    return {unitName(outline.metres_per_unit), outline.metres_per_unit, decimalsOf(outline.position_step), epsg};
}

} // namespace pointrt
