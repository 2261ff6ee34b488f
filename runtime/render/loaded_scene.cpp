// SPDX-License-Identifier: Apache-2.0
#include "runtime/render/loaded_scene.h"

#include <algorithm>

#include "format/base/error.h"
#include "runtime/device_scene/clip_planes.h"
#include "runtime/device_scene/color_choice.h"
#include "runtime/device_scene/gather_sample.h"
#include "runtime/device_scene/scene_rows.h"
#include "runtime/device_scene/scene_tiles.h"
#include "runtime/render/default_colors.h"
#include "runtime/render/picture_tiles.h"
#include "runtime/scene/camera.h"
#include "runtime/scene/camera_path.h"
#include "runtime/scene/framing.h"
#include "runtime/scene/upright.h"
#include "runtime/util/unit_name.h"

namespace pointrt {
namespace {

// Progress at the start of each stage of loading, measured for scans of half a million to a million splats with an
// index in the file, on a CPU.
constexpr double kFilesShare = 0.0, kRowsShare = 0.15, kProgramsShare = 0.2, kPhotonsShare = 0.6;

double aspectOf(const RenderSettings& settings) { return static_cast<double>(settings.width) / settings.height; }

/// Scans of unknown unit are assumed to be in metres.
double unitsOf(double metres, const DeviceScene& scene) {
    const double metres_per_unit = metresPerUnit(scene);
    return metres_per_unit > 0 ? metres / metres_per_unit : metres;
}

Camera cameraWithin(const LoadedScene& loaded, const CameraRequest& request, const Bounds& bounds) {
    Camera camera = frameCamera(request, bounds.lo, bounds.hi, aspectOf(loaded.settings));
    camera.eyes_apart = unitsOf(request.eyes_apart_m, loaded.scene);
    return camera;
}

Camera framedCamera(const LoadedScene& loaded, const CameraRequest& request) {
    return cameraWithin(loaded, request, loaded.scene.bounds);
}

/// The request resolved for the current scene.
FramedRequest framed(const LoadedScene& loaded, const CameraRequest& request, const LoadRequest& load) {
    const Vec3 up = sceneUp(loaded.scene.description, loaded.settings);
    return frameScene(request, loaded.kept_sample, up, {aspectOf(loaded.settings), load.free_share}, load.fov_is_free);
}

/// The bounds without strays far outside the rest. For clean scans exactly the bounds; for scans of a few large discs,
/// the bounds of the discs, so that a floor does not cut through them.
Bounds shownBounds(const DeviceScene& scene, const SceneSample& sample, Vec3 up) {
    if (sample.splats.empty() || scene.description.instances.empty()) return scene.bounds;
    constexpr double kMargin = 0.1;       // share of each edge, for rims that the sample misses
    constexpr double kFloorMargin = 0.01; // with a larger margin, a scene visibly hovers above its floor
    if (sample.splats.size() < kEachCounts) {
        const SampleBox discs = discBounds(sample);
        return {discs.low, discs.high};
    }
    const SampleBox box = boundsOf(withoutStrays(sample));
    const Vec3 edges = box.high - box.low;
    const auto below = [&](double along_up) { return along_up > 0.5 ? kFloorMargin : kMargin; };
    const Vec3 low = box.low - Vec3{below(up.x) * edges.x, below(up.y) * edges.y, below(up.z) * edges.z};
    const Vec3 high = box.high + Vec3{below(-up.x) * edges.x, below(-up.y) * edges.y, below(-up.z) * edges.z};
    const Bounds& all = scene.bounds;
    return {{std::max(all.lo.x, low.x), std::max(all.lo.y, low.y), std::max(all.lo.z, low.z)},
            {std::min(all.hi.x, high.x), std::min(all.hi.y, high.y), std::min(all.hi.z, high.z)}};
}

bool holdsOnlyGaussians(const DeviceScene& scene) {
    const std::vector<const DeviceScan*> scans = representativeScans(scene);
    return !scans.empty() &&
           std::all_of(scans.begin(), scans.end(), [](const DeviceScan* scan) { return scan->is_gaussian; });
}

/// The range of heights that clips keep, if there are any clips.
std::optional<ValueRange> keptHeights(const SceneSample& kept, Vec3 up) {
    std::vector<double> heights;
    for (const SampledSplat& splat : kept.splats) heights.push_back(dot(splat.position, up));
    if (heights.empty()) return std::nullopt;
    const Extent extent = extentOfMost(heights);
    return extent.size() > 0 ? std::optional(ValueRange{extent.low, extent.high}) : std::nullopt;
}

void chooseColorsByDefault(LoadedScene& loaded) {
    const Vec3 up = sceneUp(loaded.scene.description, loaded.settings);
    const std::optional<DefaultColors> colors = defaultColors(loaded.scene, loaded.sample, up);
    if (!colors) return;
    loaded.settings.color_by = colors->color_by;
    if (!loaded.settings.color_range) loaded.settings.color_range = colors->range;
    if (!loaded.settings.color_range && colors->color_by == kHeight && cutsInstances(loaded.scene.description))
        loaded.settings.color_range = keptHeights(loaded.kept_sample, up);
    loaded.colored_by_default = true;
}

/// The reflectance that lamps adapt to. For an eye within the scene, the mean of what the camera sees, since it fills
/// the picture and may be darker or brighter than the rest of the scan.
StudioSubject subjectOf(const LoadedScene& loaded, const Camera& camera, const FramedRequest& view) {
    constexpr double kViridisMean = 0.28; // mean of its 256 colours
    StudioSubject subject{brightReflectance(loaded.kept_sample), view.within,
                          holdsOnlyGaussians(loaded.scene) && !loaded.settings.relight, view.walls,
                          meanReflectance(loaded.kept_sample)};
    subject.lowest = lowestIfTilted(loaded.sample, sceneUp(loaded.scene.description, loaded.settings));
    if (!view.within) return subject;
    if (camera.panorama) return subject; // a panorama sees all of it
    const ViewBasis basis{camera.right, camera.up, camera.forward};
    const SceneSample visible = visibleFrom(loaded.kept_sample, camera.eye, basis, camera.fov_deg);
    subject.reflectance = loaded.colored_by_default ? kViridisMean : meanReflectance(visible);
    return subject;
}

/// Whether to path trace by default: only scans seen from outside. Between walls, eight samples of a small lamp leave
/// noise and take up to ten times as long. Gaussian captures contain their light already.
void chooseIntegratorByDefault(LoadedScene& loaded) {
    if (loaded.subject.only_gaussians || loaded.subject.around_eye) return;
    if (!isLitByDefault(loaded.scene.description, loaded.settings)) return;
    loaded.settings.integrator = Integrator::kPath;
    loaded.settings.spp = kDefaultPathSpp;
    loaded.subject.is_path_traced = true;
    const Vec3 up = sceneUp(loaded.scene.description, loaded.settings);
    loaded.subject.is_ground = placeKindOf(loaded.scene, loaded.sample, up) == PlaceKind::kSite;
}

/// Cuts the scene, and turns the cameras that are to face the section.
void applySection(LoadedScene& loaded, const LoadRequest& request, CameraRequest& staging) {
    SceneDescription& scene = loaded.scene.description;
    const Section section = makeSection(*request.section, sceneUp(scene, loaded.settings));
    scene.clips.insert(scene.clips.end(), section.clips.begin(), section.clips.end());
    requireFewHalfSpaces(scene.clips);
    if (!request.faces_section) return;
    if (!scene.up) scene.up = sceneUp(scene, loaded.settings); // the camera of a plan has its own up
    for (CameraRequest* camera : {&loaded.settings.camera, &staging}) {
        if (!request.settings.camera.up) camera->up = section.up;
        camera->side = section.side;
        camera->keeps_side = true;
    }
    loaded.section_camera = loaded.settings.camera;
}

/// Adds surroundings to the scene, selects its tiles and uploads all tables.
void prepareScene(Device& device, LoadedScene& loaded, const LoadRequest& request) {
    DeviceScene& scene = loaded.scene;
    CameraRequest staging = request.staging;
    resolveUp(scene.description, loaded.settings.camera, staging, {knownUp(scene), request.fallback_up});
    if (request.section) applySection(loaded, request, staging);
    loaded.sample = gatherSample(scene);
    loaded.kept_sample = cutsInstances(scene.description) ? gatherKeptSample(scene) : loaded.sample;
    loaded.free_share = request.free_share;
    loaded.shown = shownBounds(scene, loaded.sample, sceneUp(scene.description, loaded.settings));
    if (request.chooses_colors) chooseColorsByDefault(loaded);
    requireColored(request.color_option, loaded.settings.color_by);
    // the up of a view from above differs; keep that of the scene
    if (loaded.settings.camera.view && !scene.description.up)
        scene.description.up = sceneUp(scene.description, loaded.settings);
    loaded.described = scene.description;
    const FramedRequest view = framed(loaded, loaded.settings.camera, request);
    loaded.settings.camera = view.camera;
    loaded.pivot = view.pivot;
    loaded.aside = view.aside;
    const FramedRequest stage_view = framed(loaded, staging, request);
    loaded.camera = framedCamera(loaded, view.camera);
    const Camera stage = framedCamera(loaded, stage_view.camera);
    loaded.subject = subjectOf(loaded, stage, stage_view);
    if (request.chooses_integrator) chooseIntegratorByDefault(loaded);
    loaded.staged_for = scene.description.staged_for.value_or(stage.eye);
    addSurroundings(scene.description, loaded.settings, stage, loaded.shown.lo, loaded.shown.hi, loaded.subject);
    if (!scene.sets.empty()) updateTiles(device, scene, tileRequest(device, loaded, request));
    uploadSceneTables(device, scene, loaded.settings);
}

TracerSize wholeFrames(const Device& device, const RenderSettings& settings) {
    return tracerSizeFor(tilingFor(device, settings.width, settings.height), settings.width);
}

} // namespace

Camera movingCamera(const LoadedScene& loaded, const Camera& first, bool follows_views, std::uint32_t frame,
                    std::uint32_t frames) {
    if (!follows_views) return turntableCamera(first, turntableAxis(loaded), frame, frames);
    const SceneDescription& scene = loaded.scene.description;
    if (scene.views.size() < 2)
        throw Error{ExitCode::kBadUsage, "--path: " + scene.path + " has " + std::to_string(scene.views.size()) +
                                             " [[view]]; a path needs at least two"};
    std::vector<Camera> keys;
    for (const NamedView& view : scene.views) {
        CameraRequest key = view.camera;
        key.panorama = first.panorama;
        key.eyes_apart_m = loaded.settings.camera.eyes_apart_m;
        keys.push_back(cameraWithin(loaded, key, loaded.shown));
    }
    const double share = frames > 1 ? static_cast<double>(frame) / (frames - 1) : 0;
    return cameraOnPath(keys, share * static_cast<double>(keys.size() - 1));
}

MeasureUnits measureUnits(const LoadedScene& loaded) {
    const double size = length(loaded.shown.hi - loaded.shown.lo);
    return {unitName(metresPerUnit(loaded.scene)), size > 0 ? size : 1};
}

TurntableAxis turntableAxis(const LoadedScene& loaded) {
    const Vec3 center = 0.5 * (loaded.scene.bounds.lo + loaded.scene.bounds.hi);
    return {loaded.settings.camera.target.value_or(center), sceneUp(loaded.scene.description, loaded.settings)};
}

ProgramKinds kindsOf(const DeviceScene& scene, const RenderSettings& settings) {
    return {scene.features, shapeKinds(scene.shape_rows), settings.integrator, scene.sky_light != NO_LIGHT,
            castsCaustics(scene)};
}

LoadedScene::~LoadedScene() {
    destroyBandTracer(device, tracer);
    destroyDeviceScene(device, scene);
}

std::unique_ptr<LoadedScene> loadScene(Device& owner, Device& worker, const LoadRequest& request,
                                       const LoadStage& stage) {
    const auto begin = [&](const char* what, double share) {
        if (stage) stage(what, share);
    };
    auto loaded = std::make_unique<LoadedScene>(owner);
    begin("reading", kFilesShare);
    loaded->settings = request.settings;
    loaded->scene = openScene(worker, request.scene, request.verbose);
    // further tiles will be loaded and evicted later
    if (request.roots_alone)
        loaded->scene.tile_cache_bytes = pictureTileMemory(worker, request.settings, request.memory);
    begin("materials and lights", kRowsShare);
    prepareScene(worker, *loaded, request);
    begin("programs", kProgramsShare);
    const TracerSize size = request.size.value_or(wholeFrames(worker, request.settings));
    createBandTracer(worker, loaded->tracer, loaded->scene, loaded->settings, size.lanes, size.film_pixels,
                     request.form);
    if (request.refines_tiles && !loaded->scene.sets.empty()) refineTiles(worker, *loaded, request);
    loaded->program_kinds = kindsOf(loaded->scene, loaded->settings);
    if (!needsPhotons(loaded->scene, loaded->settings)) return loaded;
    begin("caustics", kPhotonsShare);
    tracePhotons(worker, loaded->tracer, loaded->settings);
    return loaded;
}

} // namespace pointrt
