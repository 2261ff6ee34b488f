// SPDX-License-Identifier: Apache-2.0
#include "runtime/rays/scene_units.h"

#include "format/crs/epsg_code.h"
#include "runtime/measure/decimal_text.h"
#include "runtime/rays/scene_points.h"
#include "runtime/studies/scene_world.h"
#include "runtime/util/unit_name.h"

namespace pointrt {

SceneUnits sceneUnits(const std::vector<std::string>& paths) {
    const PointOutline outline = sceneOutline(paths);
    const SceneWorld world = sceneWorld(paths.front());
    const int epsg = world.placement == Placement{} ? epsgCode(world.crs) : 0;
    return {unitName(outline.metres_per_unit), outline.metres_per_unit, decimalsOf(outline.position_step), epsg};
}

} // namespace pointrt
