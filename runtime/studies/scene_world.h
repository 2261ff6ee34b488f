// SPDX-License-Identifier: Apache-2.0
// What scenes say of the world around them.
#pragma once

#include <string>

#include "runtime/scene/scene_description.h"

namespace pointrt {

struct SceneWorld {
    Vec3 up;              ///< unit length; 0: nothing says
    std::string crs;      ///< of the first scan that names one; or ""
    Placement placement;  ///< of that scan
    bool oriented = true; ///< all normals say which side is outside
};

/// Of a .pro, a tile set or a scene file. Of a scene file's instances the first one that says what is up, as it stands,
/// where the scene does not. Throws Error or ProError as opening these does.
SceneWorld sceneWorld(const std::string& path);

} // namespace pointrt
