// SPDX-License-Identifier: Apache-2.0
// What a scene's splats are coloured by and which of their numbers give them other materials, as splats painted on the
// host: shaders know nothing of attributes.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "format/set/tile_set.h"
#include "runtime/device_scene/device_scan.h"
#include "runtime/device_scene/splat_paint.h"
#include "runtime/scene/legend.h"
#include "runtime/scene/render_settings.h"
#include "runtime/scene/scene_description.h"

namespace pointrt {

/// All that decides how the splats of given files at given places are painted: what is equal paints alike.
struct PaintRequest {
    std::string color_by = kOwnColors; ///< the rest of the colours only where it is not that
    std::optional<ColorMap> color_map;
    std::optional<ValueRange> color_range;
    Vec3 up;                                              ///< where heights are asked for
    std::vector<std::vector<MaterialOverride>> overrides; ///< of each instance, none where shaders do them all
    bool operator==(const PaintRequest&) const = default;
};

PaintRequest paintRequest(const SceneDescription& scene, const RenderSettings& settings);

/// True where splats get other colours than their files have.
bool isColored(const RenderSettings& settings);

/// True where the splats of an instance do not stay as their file has them.
bool isPainted(const InstanceDescription& instance, const RenderSettings& settings);

/// The materials of a painted instance's overrides, but for those of rows: splats get the numbers that follow those of
/// the file's rows. Throws Error kBadInput where there are more of both than a splat can name.
std::vector<std::uint32_t> paintedMaterials(const InstanceDescription& instance, const DeviceScan& file);

/// A file as it stands in a scene, or a tile.
struct PlacedScan {
    const DeviceScan* file = nullptr;
    const InstanceDescription* instance = nullptr;
    const DeviceScan* root = nullptr; ///< of a tile's set, which tells what numbers there are, whatever tiles there are
    const TileSet* set = nullptr;     ///< of a tile
};

struct PaintPlan {
    PaintRequest request;
    std::optional<Legend> legend;                  ///< none where colours need none
    std::vector<std::optional<SplatPaint>> paints; ///< of each instance, none where it stays as it is
};

/// Throws Error kBadUsage where no scan has what it is to be coloured by, and kBadInput where an override asks for what
/// its scan has not; both say what there is.
PaintPlan planPaint(const std::vector<PlacedScan>& scans, const PaintRequest& request);

/// The words for color_by in a scene of these scans.
std::vector<std::string> colorWords(const std::vector<PlacedScan>& scans);

/// A plan on the device.
struct ScenePaint {
    PaintRequest request;
    std::optional<Legend> legend;
    std::vector<PagedBuffer> splats;            ///< instances that are painted alike share one
    std::vector<std::optional<std::size_t>> of; ///< in splats, of each instance; none: its file's
};

/// Throws Error kCannotRun.
ScenePaint paintScene(Device& device, const std::vector<PlacedScan>& scans, PaintPlan plan);
void destroyScenePaint(Device& device, ScenePaint& paint);
std::uint64_t deviceBytes(const ScenePaint& paint);

} // namespace pointrt
