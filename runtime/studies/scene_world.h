// SPDX-License-Identifier: Apache-2.0
// Up, coordinate system and orientation of a scene.
#pragma once

#include <string>

#include "runtime/scene/scene_description.h"

namespace pointrt {

struct SceneWorld {
    Vec3 up;              ///< unit length; 0 if unknown
    std::string crs;      ///< of the first scan with one, else ""
    Placement placement;  ///< of that scan
    bool oriented = true; ///< all scans have oriented normals
};

/// Reads a .pro, a tile set or a scene file. A scene file without an up of its own takes that of its first instance
/// with one, as placed. Throws Error or ProError.
SceneWorld sceneWorld(const std::string& path);

} // namespace pointrt
