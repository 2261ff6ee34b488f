// SPDX-License-Identifier: Apache-2.0
#include "runtime/device_scene/device_scene.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "format/base/error.h"
#include "format/set/open_tile.h"
#include "runtime/device_scene/environment.h"
#include "runtime/device_scene/ggx_albedo.h"
#include "runtime/device_scene/scene_rows.h"
#include "runtime/device_scene/scene_tiles.h"
#include "runtime/scene/default_lighting.h"
#include "runtime/util/on_error.h"
#include "shaders/shared/ggx_table.h"

namespace pointrt {

namespace {

using gpu::uint; // the masks of FEATURE_* cast to it

/// Loads a file unless it is loaded already.
void loadFile(Device& device, DeviceScene& scene, const std::string& path, bool verbose) {
    if (scene.files.find(path)) return;
    DeviceScan file = loadScan(device, path, verbose);
    const std::uint64_t bytes = file.device_bytes;
    scene.files.add(std::move(file), bytes, Eviction::kNever);
    scene.device_bytes += bytes;
}

/// Opens a tile set, without loading tiles.
void addSet(DeviceScene& scene, std::uint32_t number) {
    SceneSet& set = scene.sets.emplace_back();
    set.number = number;
    set.opened = openSet(scene.description.instances[number].path);
    const TileSet& tiles = set.opened.set;
    requireTile(tiles, tiles.tiles[0], set.opened.folder);
    set.root = mapScan(tilePath(set.opened, 0));
    std::copy(tiles.bounds_min.begin(), tiles.bounds_min.end(), set.root.info.bounds_min);
    std::copy(tiles.bounds_max.begin(), tiles.bounds_max.end(), set.root.info.bounds_max);
}

/// Bounds of the instances; of the bounded shapes if there are none.
Bounds findBounds(const DeviceScene& scene) {
    std::optional<Bounds> all;
    const std::vector<const DeviceScan*> scans = representativeScans(scene);
    for (std::size_t i = 0; i < scans.size(); ++i) {
        const Bounds bounds = placedBounds(scene.description.instances[i].placement, scans[i]->info);
        all = all ? joined(*all, bounds) : bounds;
    }
    if (!all) all = boundsOfShapes(scene.description);
    return all.value_or(Bounds{{-1, -1, -1}, {1, 1, 1}});
}

/// Only rough materials need the table. The others read it too but do not use the value, so zeros will do.
bool needsGgxAlbedo(std::uint32_t features) {
    return std::any_of(kMaterialKinds.begin(), kMaterialKinds.end(), [&](const MaterialKindRow& each) {
        return hasTrait(each.kind, MATERIAL_IS_ROUGH) && (features & FEATURE_MATERIAL(each.kind)) != 0;
    });
}

template <typename Row>
void replaceBuffer(Device& device, Buffer& buffer, const char* what, std::vector<Row> rows,
                   VkFormat format = VK_FORMAT_R32G32B32A32_UINT) {
    Buffer fresh = createTexelRows(device, what, std::move(rows), format);
    destroyBuffer(device, buffer);
    buffer = fresh;
}

/// Updates in place if the number of rows is unchanged.
template <typename Row>
void replaceRows(Device& device, Buffer& buffer, const char* what, std::vector<Row> rows) {
    const std::uint64_t bytes = rows.size() * sizeof(Row);
    if (bytes > 0 && buffer.bytes == bytes)
        uploadBuffer(device, buffer, rows.data(), bytes);
    else
        replaceBuffer(device, buffer, what, std::move(rows));
}

std::string skyImage(const SceneDescription& description) {
    return description.sky ? description.sky->image : std::string();
}

/// Reads the sky image; nullopt if it is on the device already, empty if the scene has none.
std::optional<Environment> readSky(const DeviceScene& scene) {
    const std::string image = skyImage(scene.description);
    if (scene.environment_texels.handle && image == scene.sky_image) return std::nullopt;
    return image.empty() ? Environment{} : makeEnvironment(readFloatImage(image));
}

/// Repaints the splats if the paint request has changed.
void updatePaint(Device& device, DeviceScene& scene, const RenderSettings& settings) {
    const PaintRequest request = paintRequest(scene.description, settings);
    if (request == scene.paint.request) return;
    const std::vector<PlacedScan> scans = placedScans(scene, scene.description);
    ScenePaint fresh = paintScene(device, scans, planPaint(scans, request));
    scene.device_bytes += deviceBytes(fresh) - deviceBytes(scene.paint);
    destroyScenePaint(device, scene.paint);
    scene.paint = std::exchange(fresh, {});
}

void uploadSky(Device& device, DeviceScene& scene, const RenderSettings& settings, std::optional<Environment> map) {
    if (map) {
        scene.sky_image.clear(); // until the upload is complete
        replaceBuffer(device, scene.environment_texels, "environment buffer", std::exchange(map->texels, {}),
                      VK_FORMAT_R32G32B32A32_SFLOAT);
        replaceBuffer(device, scene.environment_cdf, "environment distribution", std::exchange(map->cdf, {}),
                      VK_FORMAT_R32_SFLOAT);
        scene.sky_image = skyImage(scene.description);
        scene.sky_sizes = std::move(*map);
    }
    if (scene.sky_image.empty()) return;
    const SkyDescription& sky = *scene.description.sky;
    const auto rows = mapFromWorld(sceneUp(scene.description, settings), sky.rotation_deg);
    scene.environment = environmentFrame(scene.sky_sizes, rows, sky.strength);
}

void uploadRows(Device& device, DeviceScene& scene, SceneRows rows) {
    for (std::size_t i = 0; i < scene.instances.size(); ++i) {
        Instance& instance = scene.instances[i];
        instance.params = rows.instances[i];
        uploadBuffer(device, instance.params_buffer, &instance.params, sizeof instance.params);
    }
    const bool table = needsGgxAlbedo(rows.features);
    if (!scene.ggx_albedo.handle || table != needsGgxAlbedo(scene.features))
        replaceBuffer(device, scene.ggx_albedo, "GGX table",
                      table ? ggxAlbedoTable() : std::vector<GgxAlbedo>(GGX_TABLE_ENTRIES), VK_FORMAT_R32G32_SFLOAT);
    scene.features = rows.features;
    scene.casting_shapes = std::move(rows.casting_shapes);
    scene.shape_rows = rows.shapes;
    scene.light_rows = rows.lights;
    scene.sky_light = rows.sky_light;
    replaceRows(device, scene.materials, "material buffer", std::move(rows.materials));
    replaceRows(device, scene.shapes, "shape buffer", std::move(rows.shapes));
    replaceRows(device, scene.lights, "light buffer", std::move(rows.lights));
}

/// The painted splats of an instance; null if it is not painted.
const PaintedSplats* paintedSplats(const DeviceScene& scene, const Instance& instance) {
    const std::vector<std::optional<std::size_t>>& painted = scene.paint.of;
    if (instance.place >= painted.size() || !painted[instance.place]) return nullptr;
    return &scene.paint.splats[*painted[instance.place]];
}

/// All programs bind an instance's buffers, even those that never read them.
void addBlank(Device& device, DeviceScene& scene) {
    scene.blank.file = scene.files.add(blankScan(device), 0, Eviction::kNever);
    scene.blank.params_buffer =
        createBuffer(device, "instance parameters", sizeof scene.blank.params, VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT);
}

} // namespace

DeviceScene openScene(Device& device, SceneDescription description, bool verbose) {
    DeviceScene scene;
    scene.description = std::move(description);
    const OnError undo([&] { destroyDeviceScene(device, scene); });
    const std::vector<InstanceDescription>& instances = scene.description.instances;
    for (std::uint32_t i = 0; i < instances.size(); ++i)
        if (isTileSet(instances[i].path))
            addSet(scene, i);
        else
            loadFile(device, scene, instances[i].path, verbose);
    std::vector<pro_info> infos;
    for (const DeviceScan* scan : representativeScans(scene)) infos.push_back(tracedFrame(*scan));
    scene.space = chooseRenderSpace(scene.description, infos);
    scene.bounds = findBounds(scene);
    rebuildInstances(device, scene);
    if (instances.empty()) addBlank(device, scene);
    return scene;
}

void uploadSceneTables(Device& device, DeviceScene& scene, const RenderSettings& settings) {
    SceneRows rows = makeSceneRows(scene, scene.description, settings);
    updatePaint(device, scene, settings);
    uploadSky(device, scene, settings, readSky(scene));
    uploadRows(device, scene, std::move(rows));
}

bool haveSameFiles(const SceneDescription& a, const SceneDescription& b) {
    return std::equal(
        a.instances.begin(), a.instances.end(), b.instances.begin(), b.instances.end(),
        [](const InstanceDescription& one, const InstanceDescription& other) { return one.path == other.path; });
}

void placeInstances(Device& device, DeviceScene& scene, SceneDescription description) {
    scene.description = std::move(description);
    scene.device_bytes -= deviceBytes(scene.paint); // heights may differ
    destroyScenePaint(device, scene.paint);
    scene.bounds = findBounds(scene);
    rebuildInstances(device, scene);
}

bool haveSamePlacements(const SceneDescription& a, const SceneDescription& b) {
    return std::equal(a.instances.begin(), a.instances.end(), b.instances.begin(), b.instances.end(),
                      [](const InstanceDescription& one, const InstanceDescription& other) {
                          return one.path == other.path && one.placement == other.placement;
                      });
}

void uploadSceneRows(Device& device, DeviceScene& scene, const SceneDescription& description,
                     const RenderSettings& settings, SceneRows rows) {
    scene.description = description;
    uploadSky(device, scene, settings, std::nullopt);
    uploadRows(device, scene, std::move(rows));
}

bool mergesGaussians(const DeviceScene& scene) {
    std::size_t count = 0;
    for (const Instance& each : scene.instances)
        // the set may load further tiles, so one tile counts as several instances
        if (scene.files[each.file].is_gaussian) count += each.tile ? 2 : 1;
    return count > 1;
}

bool hasGaussians(const DeviceScene& scene) {
    return std::any_of(scene.instances.begin(), scene.instances.end(),
                       [&](const Instance& each) { return scene.files[each.file].is_gaussian; });
}

bool castsCaustics(const DeviceScene& scene) {
    const auto casts = [](const Instance& instance) { return instance.params.materials.w != 0; };
    const std::vector<bool>& shapes = scene.casting_shapes;
    return !scene.light_rows.empty() && (std::any_of(scene.instances.begin(), scene.instances.end(), casts) ||
                                         std::find(shapes.begin(), shapes.end(), true) != shapes.end());
}

std::vector<PlacedScan> placedScans(const DeviceScene& scene, const SceneDescription& description) {
    std::vector<PlacedScan> scans;
    for (const Instance& each : scene.instances) {
        const InstanceDescription& instance = description.instances.at(each.number);
        scans.push_back({&scene.files[each.file], &instance});
        if (!each.tile) continue;
        const SceneSet& set = *std::find_if(scene.sets.begin(), scene.sets.end(),
                                            [&](const SceneSet& one) { return one.number == each.number; });
        scans.back().root = &set.root;
        scans.back().set = &set.opened.set;
    }
    return scans;
}

std::vector<const DeviceScan*> representativeScans(const DeviceScene& scene) {
    std::vector<const DeviceScan*> scans;
    auto set = scene.sets.begin();
    for (std::uint32_t i = 0; i < scene.description.instances.size(); ++i) {
        if (set != scene.sets.end() && set->number == i) {
            scans.push_back(&set++->root);
            continue;
        }
        scans.push_back(&scene.files[scene.files.find(scene.description.instances[i].path).value()]);
    }
    return scans;
}

std::optional<Vec3> knownUp(const DeviceScan& file, const Placement& placement) {
    pro_world world;
    pro_get_world(file.file, &world);
    const Vec3 up{world.up[0], world.up[1], world.up[2]};
    if (up == Vec3{}) return std::nullopt;
    return normalize(turned(placement, up));
}

std::optional<Vec3> knownUp(const DeviceScene& scene) {
    const std::vector<const DeviceScan*> scans = representativeScans(scene);
    for (std::size_t i = 0; i < scans.size(); ++i)
        if (const auto up = knownUp(*scans[i], scene.description.instances[i].placement)) return up;
    return std::nullopt;
}

double metresPerUnit(const DeviceScene& scene) {
    const std::vector<const DeviceScan*> scans = representativeScans(scene);
    for (std::size_t i = 0; i < scans.size(); ++i) {
        pro_world world;
        pro_get_world(scans[i]->file, &world);
        const double metres = world.metres_per_unit / scene.description.instances[i].placement.scale;
        if (metres > 0) return metres;
    }
    return 0;
}

PagedBuffers instancePages(const DeviceScene& scene, const Instance& instance) {
    const DeviceScan& file = scene.files[instance.file];
    const PaintedSplats* const painted = paintedSplats(scene, instance);
    return painted ? paintedPages(file, *painted) : pagedBuffers(file);
}

std::vector<BufferBinding> instanceBindings(const DeviceScene& scene, const Instance& instance) {
    const DeviceScan& file = scene.files[instance.file];
    const PaintedSplats* const painted = paintedSplats(scene, instance);
    std::vector<BufferBinding> bindings = painted ? paintedBindings(file, *painted) : scanBindings(file);
    for (const BufferBinding& each : sceneBindings(scene, instance)) bindings.push_back(each);
    return bindings;
}

std::vector<BufferBinding> sceneBindings(const DeviceScene& scene, const Instance& instance) {
    return {{BINDING_INSTANCE, &instance.params_buffer},
            {BINDING_MATERIALS, &scene.materials},
            {BINDING_SHAPES, &scene.shapes},
            {BINDING_LIGHTS, &scene.lights},
            {BINDING_GGX_ALBEDO, &scene.ggx_albedo},
            {BINDING_ENVIRONMENT_TEXELS, &scene.environment_texels},
            {BINDING_ENVIRONMENT_CDF, &scene.environment_cdf}};
}

void destroyDeviceScene(Device& device, DeviceScene& scene) {
    for (Buffer* buffer : {&scene.materials, &scene.shapes, &scene.lights, &scene.ggx_albedo, &scene.environment_texels,
                           &scene.environment_cdf})
        destroyBuffer(device, *buffer);
    destroyScenePaint(device, scene.paint);
    destroyBuffer(device, scene.blank.params_buffer);
    for (Instance& instance : scene.instances) destroyBuffer(device, instance.params_buffer);
    for (DeviceScan& file : scene.files) destroyScan(device, file);
    for (SceneSet& set : scene.sets) destroyScan(device, set.root);
    scene = {};
}

} // namespace pointrt
