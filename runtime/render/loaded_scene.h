// SPDX-License-Identifier: Apache-2.0
// A described scene on the device with all that it takes to trace it: the one way there, for files, the window and
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
#include "runtime/scene/turntable.h"

namespace pointrt {

/// What a tracer's programs are built for.
struct ProgramKinds {
    std::uint32_t features = 0, shape_kinds = 0;
    Integrator integrator = Integrator::kPhong;
    bool sky_image = false, caustics = false;
    bool operator==(const ProgramKinds&) const = default;
};

ProgramKinds kindsOf(const DeviceScene& scene, const RenderSettings& settings);

/// It does not move: the tracer points at the scene.
struct LoadedScene {
    /// owner frees what is here, and outlives it.
    explicit LoadedScene(Device& owner) : device(owner) {}
    ~LoadedScene();
    LoadedScene(const LoadedScene&) = delete;
    LoadedScene& operator=(const LoadedScene&) = delete;

    Device& device;
    SceneDescription
        described; ///< as its file has it, standing upright; scene.description has what stands around it besides
    RenderSettings settings;   ///< that its tables are made for
    Camera camera;             ///< the first
    Vec3 staged_for;           ///< the eye that its surroundings were put up for, world frame
    SceneSample sample;        ///< of its scans
    Bounds shown;              ///< of the scene without strays
    std::optional<Vec3> pivot; ///< in the middle of what the first camera shows, where it was framed for that
    StudioSubject subject;
    double free_share = 1; ///< LoadRequest::free_share
    double aside = 0;      ///< how far that is left of the picture's middle, in heights of the picture
    DeviceScene scene;
    BandTracer tracer; ///< for ProgressiveRenderer
    ProgramKinds program_kinds;
    bool lacks_photons = false; ///< since its tables were changed: it throws caustics that the tracer does not have yet
};

/// What pictures of a turntable of the scene go around.
TurntableAxis turntableAxis(const LoadedScene& loaded);

struct LoadRequest {
    SceneDescription scene;
    RenderSettings settings;
    CameraRequest staging;              ///< what surroundings are put up for: the settings' camera, were there no view
    std::optional<TracerSize> size;     ///< of the tracer; none: for whole frames of the settings' size
    std::optional<Vec3> fallback_up;    ///< where neither scene nor scans say it; none: what the camera has
    bool fov_is_free = false;           ///< nobody has said it: it may become wider
    double free_share = 1;              ///< of the picture's width, from the left: nothing covers it
    std::uint64_t memory = kTileMemory; ///< bytes for pictures of sets
    bool roots_alone = false;           ///< of sets, for now: the scene is there soon, tiles follow
    std::uint32_t turntable = 0;        ///< pictures of a turntable that tiles are chosen for; 0: for the first camera
    bool refines_tiles = false;         ///< those that no camera sees as well, where rays meet them
    bool verbose = false;
    FormRequest form; ///< of its passes
};

/// Called as a stage of loading begins, with a word for it and the share of the whole that is done by then. It may
/// throw to give the loading up.
using LoadStage = std::function<void(const char* stage, double share)>;

/// Loads on the calling thread. worker: the owner's for that thread, or the owner. stage may be empty. Throws Error as
/// openScene, frameCamera and uploadSceneTables do.
std::unique_ptr<LoadedScene> loadScene(Device& owner, Device& worker, const LoadRequest& request,
                                       const LoadStage& stage);

} // namespace pointrt
