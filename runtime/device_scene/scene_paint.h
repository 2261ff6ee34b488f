// SPDX-License-Identifier: Apache-2.0
// Colours by attribute, and materials by attribute, applied to splats on the host: shaders do not read attributes.
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

/// Everything that determines how the splats of placed files are painted: equal requests give equal results.
struct PaintRequest {
    std::string color_by = kOwnColors; ///< the colour map and range are set only if it is not kOwnColors
    std::optional<ColorMap> color_map;
    std::optional<ValueRange> color_range;
    Vec3 up;                                              ///< set only if heights are used
    float splat_size = 1;                                 ///< RenderSettings::splat_size
    std::vector<FilterDescription> filters;               ///< the enabled ones
    std::vector<std::vector<MaterialOverride>> overrides; ///< for each instance; empty if shaders apply all of them
    std::vector<bool> colored; ///< whether color_by applies to each instance, if it is not the scans' own colours
    bool operator==(const PaintRequest&) const = default;
};

PaintRequest paintRequest(const SceneDescription& scene, const RenderSettings& settings);

/// Whether the splats of an instance get other colours than those of its file.
bool isColored(const InstanceDescription& instance, const RenderSettings& settings);

/// Whether an instance's own settings make its splats differ from those of its file. Filters do so for all instances
/// (hidesSplats). Gaussians are never painted.
bool isPainted(const InstanceDescription& instance, const RenderSettings& settings);
/// Whether any splats of the scene differ from those of their files.
bool paintsScans(const SceneDescription& scene, const RenderSettings& settings);

/// The materials of a painted instance's overrides, except overrides of whole rows. Their row numbers follow those of
/// the file. Throws Error kBadInput if there are more rows in all than a splat can name.
std::vector<std::uint32_t> paintedMaterials(const InstanceDescription& instance, const DeviceScan& file);

/// A file or tile with its instance.
struct PlacedScan {
    const DeviceScan* file = nullptr;
    const InstanceDescription* instance = nullptr;
    /// For a tile, the root of its set: which numbers exist must not depend on the loaded tiles.
    const DeviceScan* root = nullptr;
    const TileSet* set = nullptr; ///< of a tile, else null
};

struct PaintPlan {
    PaintRequest request;
    std::optional<Legend> legend;                  ///< nullopt if the colours need none
    std::vector<std::optional<SplatPaint>> paints; ///< for each instance; nullopt if it is not painted
};

/// Throws Error kBadUsage if no scan has the number to colour by, and kBadInput if a scan lacks the number of an
/// override, or every scan lacks the number of a filter. The messages list what is available.
PaintPlan planPaint(const std::vector<PlacedScan>& scans, const PaintRequest& request);

/// The values of color_by that these scans support.
std::vector<std::string> colorWords(const std::vector<PlacedScan>& scans);

/// The splats of a file as painted, on the device.
struct PaintedSplats {
    PagedBuffer splats;
    std::uint64_t shown = 0; ///< splats that filters do not hide
    /// The file's near splats without the hidden ones, at the drawn size; none: use the file's.
    std::optional<PagedBuffer> near;
};

/// Throws Error kCannotRun.
PaintedSplats paintScan(Device& device, const DeviceScan& file, const SplatPaint& paint);
void destroyPaintedSplats(Device& device, PaintedSplats& painted);
/// scanBindings with the painted buffers in place of the file's.
std::vector<BufferBinding> paintedBindings(const DeviceScan& file, const PaintedSplats& painted);
/// The same for pagedBuffers.
PagedBuffers paintedPages(const DeviceScan& file, const PaintedSplats& painted);

/// Painted splats on the device.
struct ScenePaint {
    PaintRequest request;
    std::optional<Legend> legend;
    std::vector<PaintedSplats> splats;          ///< shared by instances that are painted alike
    std::vector<std::optional<std::size_t>> of; ///< for each instance: its index in splats; nullopt: uses its file's
};

/// Throws Error kCannotRun.
ScenePaint paintScene(Device& device, const std::vector<PlacedScan>& scans, PaintPlan plan);
void destroyScenePaint(Device& device, ScenePaint& paint);
/// Whether filters hide all splats of the scene.
bool hidesAllSplats(const ScenePaint& paint);
std::uint64_t deviceBytes(const ScenePaint& paint);

} // namespace pointrt
