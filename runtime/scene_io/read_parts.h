// SPDX-License-Identifier: Apache-2.0
// The sections of a scene file: each function reads one from the whole file into reading.scene.
#pragma once

#include <map>
#include <set>
#include <string>

#include "runtime/scene/render_setting_table.h"
#include "runtime/scene_io/values.h"

namespace pointrt {

struct SceneReading {
    SceneDescription scene; ///< path and up come before the sections, materials and lights before what asks for them
    std::map<std::string, std::uint32_t, std::less<>> material_of_name;
    std::set<std::uint32_t> uncolored_materials; ///< which have splats' colours only
};

/// Keys of the render settings in a table of the file, in the order of messages.
std::vector<std::string_view> settingKeys(FileTable table);
/// What values, which are such a table, say of them.
void readSettings(const SceneValue& values, FileTable table, RenderChoices& choices);
/// [render], which needs nothing of the rest.
void readRender(const SceneValue& file, SceneDescription& scene);
void readMaterials(const SceneValue& file, SceneReading& reading);
void readInstances(const SceneValue& file, SceneReading& reading);
void readShapes(const SceneValue& file, SceneReading& reading);
void readLights(const SceneValue& file, SceneReading& reading);
void readSky(const SceneValue& file, SceneReading& reading);

/// Number of the material that value names.
std::uint32_t materialOf(const SceneValue& value, const SceneReading& reading);
/// The file that value names, relative to the scene file's folder; it is there.
std::string fileOf(const SceneValue& value, const SceneReading& reading);
/// Rows of the matrix that value's rotations make, in their order: {axis, degrees} or a list of them.
std::array<Vec3, 3> rotationOf(const SceneValue& value);

/// [[x, y, z], [x, y, z], [x, y, z]]
std::array<Vec3, 3> rowsOf(const SceneValue& value);
/// What rows of written matrices may be off by, as a sine: six digits are enough to write one.
constexpr double kAxesError = 1e-6;
/// True where axes, of unit length, are at right angles to each other and right-handed.
bool areRightAngled(const std::array<Vec3, 3>& axes);

/// Half edges of a rectangle. Refuses table where they are not at right angles.
struct HalfEdges {
    Vec3 u, v;
};
HalfEdges halfEdgesOf(const SceneValue& table);

/// Puts a flat shape into the plane of normal, a unit vector; u and v get length half.
void layFlat(ShapeDescription& shape, Vec3 normal, double half);

/// Refuses value where its shape is one more than MAX_SHAPES: shapes and lights with a surface together.
void requireRoomForShape(const SceneValue& value, const SceneReading& reading);

} // namespace pointrt
