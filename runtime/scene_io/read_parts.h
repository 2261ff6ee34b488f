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
    SceneDescription scene; ///< path and up are read before the sections, materials before the users of materials
    std::map<std::string, std::uint32_t, std::less<>> material_of_name;
    std::set<std::uint32_t> uncolored_materials; ///< materials that have only the splats' colours
};

/// Keys of the render settings in a table of the file, in the order of messages.
std::vector<std::string_view> settingKeys(FileTable table);
/// Reads the render settings in values, a table of this kind.
void readSettings(const SceneValue& values, FileTable table, RenderChoices& choices);
/// Reads [render].
void readRender(const SceneValue& file, SceneDescription& scene);
void readMaterials(const SceneValue& file, SceneReading& reading);
void readInstances(const SceneValue& file, SceneReading& reading);
void readClips(const SceneValue& file, SceneReading& reading);
void readFilters(const SceneValue& file, SceneReading& reading);
void readMeasures(const SceneValue& file, SceneReading& reading);
void readShapes(const SceneValue& file, SceneReading& reading);
void readLights(const SceneValue& file, SceneReading& reading);
void readSky(const SceneValue& file, SceneReading& reading);

/// Reads the keys "name" and "locked".
void takeLayer(const SceneValue& table, Layer& layer);

/// Number of the material that value names.
std::uint32_t materialOf(const SceneValue& value, const SceneReading& reading);
/// The selection by the numbers that attribute names: from exactly one of the keys "values" and "range" of table.
SplatSelection selectionOf(const SceneValue& table, const SceneValue& attribute);
/// The path of the file that value names relative to the scene file's folder. Refuses missing files.
std::string fileOf(const SceneValue& value, const SceneReading& reading);
/// The matrix of a rotation {axis, degrees} or {matrix}, or of a list of them, applied in order. Returns its rows.
std::array<Vec3, 3> rotationOf(const SceneValue& value);

/// [[x, y, z], [x, y, z], [x, y, z]]
std::array<Vec3, 3> rowsOf(const SceneValue& value);
/// Tolerance of matrices in files, as a sine, so that six digits are enough.
constexpr double kAxesError = 1e-6;
/// True if axes, of unit length, are orthogonal and right-handed.
bool areRightAngled(const std::array<Vec3, 3>& axes);

/// Half edges of a rectangle. Refuses table if they are not perpendicular.
struct HalfEdges {
    Vec3 u, v;
};
HalfEdges halfEdgesOf(const SceneValue& table);

/// Orients a flat shape so that its normal is the given one, of unit length; u and v get length half.
void layFlat(ShapeDescription& shape, Vec3 normal, double half);

/// Refuses value if there are MAX_SHAPES shapes already, counting lights with a surface.
void requireRoomForShape(const SceneValue& value, const SceneReading& reading);

} // namespace pointrt
