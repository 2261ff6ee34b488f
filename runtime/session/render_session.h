// SPDX-License-Identifier: Apache-2.0
// A device with a loaded scene, ready to render to files.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "runtime/gpu/device.h"
#include "runtime/render/loaded_scene.h"
#include "runtime/render/progressive_renderer.h"
#include "runtime/scene/render_settings.h"
#include "runtime/session/options.h"
#include "runtime/session/report.h"

namespace pointrt {

/// The device's resources, freed in order however the run ends.
struct RenderSession {
    Device device;
    std::optional<PassProfile> profile; ///< with options.profile
    std::unique_ptr<LoadedScene> loaded;
    std::optional<ProgressiveRenderer> renderer; ///< of loaded
    RenderSettings settings;                     ///< of loaded, with the film layers that the files need
    Camera camera;
    std::vector<std::string> notes; ///< sceneNotes

    explicit RenderSession(const Options& options);
    RenderSession(const RenderSession&) = delete;
    RenderSession& operator=(const RenderSession&) = delete;
    ~RenderSession();
};

/// Loads description onto the device with options, and describes both in report. Throws Error as resolveSettings and
/// loadScene do.
void loadSession(RenderSession& session, SceneDescription description, const Options& options, Report& report);

/// Prints the notes on stderr, unless options are quiet. Call it once the pictures are written: a failed run prints
/// only its error.
void printNotes(const RenderSession& session, const Options& options);

/// wantsDenoising (settings.h) for a loaded scene.
bool wantsDenoising(const RenderSession& session, const Options& options, std::uint32_t samples);

/// Frees the tracer's memory after the last sample, since the denoiser needs as much again.
void dropRenderer(RenderSession& session);

} // namespace pointrt
