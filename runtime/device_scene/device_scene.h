// SPDX-License-Identifier: Apache-2.0
// A scene on the device: .pro files and their instances, shapes, materials and lights.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "runtime/device_scene/device_scan.h"
#include "runtime/device_scene/environment.h"
#include "runtime/device_scene/opened_set.h"
#include "runtime/device_scene/render_space.h"
#include "runtime/device_scene/resident_files.h"
#include "runtime/device_scene/scene_paint.h"
#include "runtime/gpu/device.h"
#include "runtime/gpu/resources.h"
#include "runtime/scene/scene_description.h"
#include "shaders/shared/params.h"

namespace pointrt {

/// A file with its placement in the scene: a whole scan, or a tile.
struct Instance {
    std::uint32_t file = 0;            ///< slot in DeviceScene::files
    std::uint32_t number = 0;          ///< index in SceneDescription::instances; all tiles of a set have the same one
    std::size_t place = 0;             ///< in DeviceScene::instances
    std::optional<std::uint32_t> tile; ///< of a tile: its number in its set
    gpu::InstanceParams params{};
    Buffer params_buffer;
    bool oriented = false;
};

/// A tile set that is an instance of the description.
struct SceneSet {
    std::uint32_t number = 0; ///< of that instance
    OpenedSet opened;
    DeviceScan root; ///< mapped, not on the device: represents the set whichever tiles are loaded; has the set's bounds
    bool reported_coarse = false;
};

struct SceneRows; // of scene_rows.h

struct DeviceScene {
    SceneDescription description;
    RenderSpace space;
    ResidentFiles files;             ///< each .pro once, however many instances it has
    std::vector<SceneSet> sets;      ///< in the order of their instances
    std::vector<Instance> instances; ///< in the order of the description, with a set's tiles in its place
    Instance blank;                  ///< bound in scenes without instances
    ScenePaint paint;
    Bounds bounds; ///< of the instances; of the bounded shapes if there are none
    std::vector<gpu::Light> light_rows;
    std::vector<gpu::Shape> shape_rows;
    std::vector<bool> casting_shapes;    ///< [shownShapes] whether each casts caustics
    std::uint32_t features = 0;          ///< FEATURE_* of shaders/shared/params.h, for the current settings
    std::uint32_t sky_light = NO_LIGHT;  ///< number of the sky image's light
    gpu::EnvironmentFrame environment{}; ///< of the sky image
    std::string sky_image;               ///< path of the sky image on the device
    Environment sky_sizes;               ///< of the sky image, without texels
    std::uint64_t splat_count = 0;
    std::uint64_t device_bytes = 0;
    /// Keep unused tiles while all files together take no more than this; 0: evict them at once.
    std::uint64_t tile_cache_bytes = 0;
    Buffer materials, shapes, lights, ggx_albedo, environment_texels, environment_cdf;
};

/// Loads the files of description, opens its tile sets and makes the instances of the files. Next, load the tiles of
/// the sets with updateTiles (scene_tiles.h). Then upload shapes, materials and lights, which may depend on the bounds,
/// with uploadSceneTables. Throws Error as loadScan and openSet do.
DeviceScene openScene(Device& device, SceneDescription description, bool verbose);

/// Uploads the shapes, materials, lights and painted splats of scene.description, replacing the previous ones. Reads
/// the sky image and paints splats only if those changed. Throws Error kBadInput if the image cannot be read or an
/// override names a material row that its file does not have, and as planPaint does; the scene is unchanged then.
void uploadSceneTables(Device& device, DeviceScene& scene, const RenderSettings& settings);

/// Replaces the description by one that differs in materials, lights or shapes only, in a few milliseconds. Files,
/// placements, sky image and paint request (paintRequest) must be the current ones. rows must have the scene's
/// features, which its programs were built for.
/// @param rows makeSceneRows of description
void uploadSceneRows(Device& device, DeviceScene& scene, const SceneDescription& description,
                     const RenderSettings& settings, SceneRows rows);

/// The up direction that a file stores, rotated by its placement; unit length.
std::optional<Vec3> knownUp(const DeviceScan& file, const Placement& placement);
/// The up direction of the first instance whose file has one, in the world; unit length.
std::optional<Vec3> knownUp(const DeviceScene& scene);

/// Metres per unit of the scene, according to the first scan that stores it; 0 if none does.
double metresPerUnit(const DeviceScene& scene);

/// Whether both have the same files in the same order.
bool haveSameFiles(const SceneDescription& a, const SceneDescription& b);
/// Whether both have the same files with the same placements.
bool haveSamePlacements(const SceneDescription& a, const SceneDescription& b);

/// Rebuilds the instances for a description with the same files in other places; keeps the render space. Next, call
/// uploadSceneTables. The loaded tiles of sets stay those for the former placement.
void placeInstances(Device& device, DeviceScene& scene, SceneDescription description);

/// Whether some instance holds Gaussians.
bool hasGaussians(const DeviceScene& scene);

/// Whether rays may pass through Gaussians of several instances, which must be composited in one order.
bool mergesGaussians(const DeviceScene& scene);

/// Whether there are lights and anything that casts caustics.
bool castsCaustics(const DeviceScene& scene);

/// One entry for each instance of scene, with its placement in description.
std::vector<PlacedScan> placedScans(const DeviceScene& scene, const SceneDescription& description);

/// A scan that represents each instance of the description: its file, or the root of its set.
std::vector<const DeviceScan*> representativeScans(const DeviceScene& scene);

/// The paged buffers of an instance.
PagedBuffers instancePages(const DeviceScene& scene, const Instance& instance);

/// The buffers of an instance, or of scene.blank, for the bindings of shaders/lib/bindings.glsl.
std::vector<BufferBinding> instanceBindings(const DeviceScene& scene, const Instance& instance);
/// The bindings of instanceBindings that do not belong to a file.
std::vector<BufferBinding> sceneBindings(const DeviceScene& scene, const Instance& instance);

void destroyDeviceScene(Device& device, DeviceScene& scene);

} // namespace pointrt
