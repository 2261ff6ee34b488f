// SPDX-License-Identifier: Apache-2.0
#include "runtime/session/load_request.h"

#include <utility>

#include "runtime/scene_io/scene_file.h"
#include "runtime/session/settings.h"

namespace pointrt {
namespace {

/// Whether the picture's look is left to the viewer: a PNG of a scan, without options for light, shading or samples.
bool leavesIntegrator(const Options& options) {
    const RenderChoices& said = options.choices;
    const bool is_picture = writesToneMapped(options) && options.thumbnail == 0 && options.bench_frames == 0;
    const bool is_limited = options.limits.seconds || options.limits.noise;
    const bool is_sampled = said.integrator || said.spp || said.bounces;
    const bool is_lit = said.room || said.lights || said.background || said.shadows || said.caustics;
    const bool is_shaded = said.blend || said.reflectivity;
    return is_picture && !isSceneFile(options.scene) && !is_limited && !is_sampled && !is_lit && !is_shaded;
}

/// Whether the camera looks at the section because no option places it elsewhere.
bool facesSection(const Options& options) {
    return options.section && !options.camera.eye && !options.camera.target && options.view.empty() &&
           !options.panorama;
}

/// The lens of the camera that looks at the section, and an up that only rotates the picture.
CameraRequest sectionCamera(const Options& options) {
    CameraRequest camera;
    if (!options.up_axis) camera.up = options.camera.up;
    camera.ortho = !options.fov_deg;
    camera.ortho_height = options.camera.ortho_height;
    camera.fov_deg = options.fov_deg.value_or(camera.fov_deg);
    return camera;
}

} // namespace

LoadRequest loadRequest(const Options& options, SceneDescription scene) {
    LoadRequest request;
    request.settings = resolveSettings(options, scene);
    Options without_view = options;
    // lamps are placed for the scene's own camera, or else for the requested standard view
    if (!standardView(options, scene) || scene.camera.eye) without_view.view.clear();
    request.staging = resolveSettings(without_view, scene).camera;
    request.section = options.section;
    request.faces_section = facesSection(options);
    if (request.faces_section) request.settings.camera = request.staging = sectionCamera(options);
    request.fov_is_free = !options.fov_deg && request.settings.camera.fov_deg == CameraRequest{}.fov_deg;
    // scene files and other options decide how scans look
    request.chooses_colors = leavesColors(options);
    request.color_option = colorOption(options.choices);
    request.chooses_integrator = leavesIntegrator(options);
    request.scene = std::move(scene);
    if (isSceneFile(options.scene)) request.fallback_up = Vec3{0, 1, 0}; // not the camera's up, which may be tilted
    request.memory = options.memory.value_or(kTileMemory);
    request.turntable = options.turntable;
    request.follows_views = options.follows_views;
    request.verbose = options.verbose;
    return request;
}

} // namespace pointrt
