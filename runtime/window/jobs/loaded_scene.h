// SPDX-License-Identifier: Apache-2.0
// A scene on the device, with a tracer for it, that is edited while it is looked at.
#pragma once

#include <cstdint>
#include <memory>

#include "runtime/device_scene/device_scene.h"
#include "runtime/gpu/device.h"
#include "runtime/session/options.h"
#include "runtime/tracer/band_tracer.h"
#include "runtime/window/jobs/job.h"

namespace pointrt {

/// What a tracer's programs are built for.
struct ProgramKinds {
    std::uint32_t features = 0;
    Integrator integrator = Integrator::kPhong;
    bool sky_image = false, caustics = false;
    bool operator==(const ProgramKinds&) const = default;
};

/// It does not move: the tracer points at the scene.
struct LoadedScene {
    /// owner frees what is here, and outlives it.
    explicit LoadedScene(Device& owner) : device(owner) {}
    ~LoadedScene();
    LoadedScene(const LoadedScene&) = delete;
    LoadedScene& operator=(const LoadedScene&) = delete;

    Device& device;
    SceneDescription described; ///< as its file has it; scene.description has what stands around it besides
    RenderSettings settings;    ///< that it is furnished for
    Camera camera;              ///< the first
    Vec3 staged_for;            ///< the eye that its surroundings were put up for, world frame
    DeviceScene scene;
    BandTracer tracer; ///< for ViewportRenderer
    ProgramKinds program_kinds;
    bool lacks_photons = false; ///< since refurnishNow: the scene throws caustics, for which it takes a refurnish
};

/// Loads options.scene with the rest of what the command line says. worker: of owner, for the calling thread. Tells
/// control the stages. Throws Error as describeScene, resolveSettings, openScene and frameCamera do, and JobCancelled.
std::unique_ptr<LoadedScene> loadFromFile(Device& owner, Device& worker, const Options& options, JobControl& control);

/// loaded.described with the surroundings that settings ask for, put up for the same eye as at first.
SceneDescription withSurroundings(const LoadedScene& loaded, const RenderSettings& settings);

/// Furnishes loaded for description, which has its surroundings, and settings: rows, and, where it takes others,
/// programs and photons. Nobody else may use loaded meanwhile; pictures of it start over. Throws Error kBadInput where
/// a picture of the sky cannot be read or description names other files or places, with nothing changed. Cancelled, it
/// leaves photons out, for good, and nothing else.
void refurnish(Device& device, LoadedScene& loaded, const SceneDescription& description, const RenderSettings& settings,
               JobControl& control);

/// The same in a few milliseconds and without photons, where the tracer's programs will do. Returns false, with nothing
/// changed, where they will not.
bool refurnishNow(Device& device, LoadedScene& loaded, const SceneDescription& description,
                  const RenderSettings& settings);

} // namespace pointrt
