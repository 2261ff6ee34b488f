// SPDX-License-Identifier: Apache-2.0
// All that is in the picture, on the device: the .pro files, where they stand, shapes, materials and lights.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "runtime/device_scene/device_scan.h"
#include "runtime/device_scene/environment.h"
#include "runtime/device_scene/opened_set.h"
#include "runtime/device_scene/render_space.h"
#include "runtime/device_scene/scene_paint.h"
#include "runtime/gpu/device.h"
#include "runtime/gpu/resources.h"
#include "runtime/scene/scene_description.h"
#include "shaders/shared/params.h"

namespace pointrt {

/// A file as it stands in the scene: a scan, or a tile of one.
struct Instance {
    std::uint32_t file = 0;            ///< in DeviceScene::files
    std::uint32_t number = 0;          ///< in SceneDescription::instances: the tiles of a set have the same one
    std::size_t place = 0;             ///< in DeviceScene::instances
    std::optional<std::uint32_t> tile; ///< of its set
    gpu::InstanceParams params{};
    Buffer params_buffer;
    bool oriented = false;
};

/// A tile set that an instance of the description names.
struct SceneSet {
    std::uint32_t number = 0; ///< of that instance
    OpenedSet opened;
    DeviceScan root; ///< mapped alone: what is to be known of the whole, whatever tiles there are; bounds are the set's
    bool told_coarse = false;
};

struct SceneRows; // of scene_rows.h

struct DeviceScene {
    SceneDescription description;
    RenderSpace space;
    std::vector<DeviceScan> files;   ///< each .pro once, however often it stands in the scene
    std::vector<SceneSet> sets;      ///< in the order of their instances
    std::vector<Instance> instances; ///< in the order of the description; in place of a set its tiles
    Instance blank;                  ///< stands for them in the bindings of scenes without any
    ScenePaint paint;
    Bounds bounds; ///< of the instances; without any, of what shapes are bounded
    std::vector<gpu::Light> light_rows;
    std::vector<gpu::Shape> shape_rows;
    std::vector<bool> casting_shapes;    ///< of description.shapes, those that throw caustics
    std::uint32_t features = 0;          ///< FEATURE_* of shaders/shared/params.h, with the settings it is furnished by
    std::uint32_t sky_light = NO_LIGHT;  ///< number of the light that stands for the sky image
    gpu::EnvironmentFrame environment{}; ///< of that image
    std::string sky_image;               ///< path of that image, which is read once
    Environment sky_sizes;               ///< of that image, without texels
    std::uint64_t splat_count = 0;
    std::uint64_t device_bytes = 0;
    std::uint64_t tile_cache_bytes = 0; ///< what tiles may take where they come and go; else those in cuts alone stay
    std::uint64_t tile_uses = 0;        ///< cuts that were put there so far
    Buffer materials, shapes, lights, ggx_albedo, environment_texels, environment_cdf;
};

/// Maps the files that description names and puts them on the device, with where they stand; shapes, materials and
/// lights follow with uploadSceneTables, for which the bounds must be known, and before them the tiles of sets, which
/// are opened here, with standTiles (scene_tiles.h). Throws Error as loadScan and openSet do.
DeviceScene openScene(Device& device, SceneDescription description, bool verbose);

/// Puts shapes, materials, lights and painted splats of scene.description, as it is now, on the device, in place of
/// those before. The sky image is read, and splats are painted, only where that is another. Throws Error kBadInput
/// where the image cannot be read, and where an override asks for a material row that its file does not have, and as
/// planPaint does; nothing is changed then.
void uploadSceneTables(Device& device, DeviceScene& scene, const RenderSettings& settings);

/// Furnishes scene for description in a few milliseconds by its rows (see makeSceneRows). It must name the files,
/// places and sky image that are there and ask for the paint that is there (paintRequest), and its rows' features must
/// be the scene's, for which its programs were built.
void uploadSceneRows(Device& device, DeviceScene& scene, const SceneDescription& description,
                     const RenderSettings& settings, SceneRows rows);

/// What is up by the first instance whose file knows, as that stands in the scene; unit length.
std::optional<Vec3> knownUp(const DeviceScene& scene);

/// Whether the same files stand at the same places.
bool standsAlike(const SceneDescription& a, const SceneDescription& b);

/// Whether anything throws caustics, and there are lights for it.
bool castsCaustics(const DeviceScene& scene);

/// The files and tiles as they stand in description.
std::vector<PlacedScan> placedScans(const DeviceScene& scene, const SceneDescription& description);

/// For each instance of the description what tells of all of it: its file, or its set's root.
std::vector<const DeviceScan*> wholeScans(const DeviceScene& scene);

/// The paged buffers of the instance with this number.
PagedBuffers instancePages(const DeviceScene& scene, const Instance& instance);

/// The buffers of an instance, or of scene.blank, at their places in shaders/lib/bindings.glsl.
std::vector<BufferBinding> instanceBindings(const DeviceScene& scene, const Instance& instance);

void destroyDeviceScene(Device& device, DeviceScene& scene);

} // namespace pointrt
