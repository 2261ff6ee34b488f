// SPDX-License-Identifier: Apache-2.0
// A scene on the device with everything needed to render it, and the function that loads it for files, the window and
// tests.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>

#include "runtime/device_scene/device_scene.h"
#include "runtime/gpu/device.h"
#include "runtime/render/band_tracer.h"
#include "runtime/render/frame_tiling.h"
#include "runtime/scene/default_lighting.h"
#include "runtime/scene/render_settings.h"
#include "runtime/scene/scene_sample.h"
#include "runtime/scene/section.h"
#include "runtime/scene/turntable.h"

namespace pointrt {

/// The traits that the programs of a tracer are specialized for.
struct ProgramKinds {
    std::uint32_t features = 0, shape_kinds = 0;
    Integrator integrator = Integrator::kPhong;
    bool sky_image = false, caustics = false;
    bool operator==(const ProgramKinds&) const = default;
};

ProgramKinds kindsOf(const DeviceScene& scene, const RenderSettings& settings);

/// Not movable: the tracer points to the scene.
struct LoadedScene {
    /// owner frees its resources and must outlive it.
    explicit LoadedScene(Device& owner) : device(owner) {}
    ~LoadedScene();
    LoadedScene(const LoadedScene&) = delete;
    LoadedScene& operator=(const LoadedScene&) = delete;

    Device& device;
    SceneDescription described; ///< as in its file, turned upright; scene.description also has surroundings
    RenderSettings settings;    ///< the settings that its tables were built for
    Camera camera;              ///< the initial camera
    std::optional<CameraRequest> section_camera; ///< looks at the section of the request; not framed yet
    Vec3 staged_for;                             ///< the eye that its surroundings were made for, world frame
    SceneSample sample;        ///< sample of the splats of its scans, for surroundings, which do not depend on clips
    SceneSample kept_sample;   ///< sample of the splats that clips keep, for framing and exposure
    Bounds shown;              ///< bounds of the scene without strays
    std::optional<Vec3> pivot; ///< centre of what the initial camera shows, if it was framed automatically
    StudioSubject subject;
    bool colored_by_default = false; ///< settings.color_by was chosen by defaultColors
    double free_share = 1;           ///< LoadRequest::free_share
    double aside = 0;                ///< distance of the pivot to the left of the picture's centre, in picture heights
    DeviceScene scene;
    BandTracer tracer; ///< for ProgressiveRenderer
    ProgramKinds program_kinds;
    bool lacks_photons = false; ///< the scene casts caustics, but its tables changed and photons were not traced yet
};

/// How the scene's measurements are written.
MeasureUnits measureUnits(const LoadedScene& loaded);

/// The axis that turntables of the scene rotate about.
TurntableAxis turntableAxis(const LoadedScene& loaded);

/// The camera for one picture of a moving camera: on a turntable, or on the path through the scene's views. Throws
/// Error kBadUsage if the path has fewer than two views, and as frameCamera does.
/// @param first of the turntable
/// @param frame below frames
Camera movingCamera(const LoadedScene& loaded, const Camera& first, bool follows_views, std::uint32_t frame,
                    std::uint32_t frames);

struct LoadRequest {
    SceneDescription scene;
    RenderSettings settings;
    CameraRequest staging;          ///< the camera for which surroundings are made: that of the settings without a view
    std::optional<TracerSize> size; ///< of the tracer; none: for frames of the settings' size
    std::optional<SectionRequest> section; ///< adds clips to the scene
    bool faces_section = false;            ///< whether the cameras of settings and staging look at the section
    std::optional<Vec3> fallback_up;       ///< up if neither scene nor scans define it; none: that of the camera
    bool chooses_colors = false;           ///< colour scans without colours by defaultColors
    const char* color_option = nullptr;    ///< an option that requireColored checks once colours are chosen
    bool chooses_integrator = false;       ///< path trace scans seen from outside that are lit by default
    bool fov_is_free = false;              ///< not specified by the user: framing may widen it
    double free_share = 1;                 ///< uncovered share of the picture's width, from the left
    std::uint64_t memory = kTileMemory;    ///< limit in bytes, see kTileMemory
    bool roots_alone = false;              ///< load only the root tiles of sets now; others follow later
    /// Number of pictures of a moving camera to select tiles for; 0: the initial camera only.
    std::uint32_t turntable = 0;
    bool follows_views = false; ///< the camera moves along the scene's views, not around the target
    bool refines_tiles = false; ///< also refine tiles outside the views where secondary rays hit them
    bool verbose = false;
    FormRequest form; ///< form of its kernels
};

/// Called at the start of each stage of loading, with its name and the progress in [0, 1]. May throw to cancel loading.
using LoadStage = std::function<void(const char* stage, double share)>;

/// Loads on the calling thread. worker: that thread's device, made from owner, or owner itself. stage may be empty.
/// Throws Error as openScene, frameCamera and uploadSceneTables do.
std::unique_ptr<LoadedScene> loadScene(Device& owner, Device& worker, const LoadRequest& request,
                                       const LoadStage& stage);

} // namespace pointrt
