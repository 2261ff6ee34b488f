// SPDX-License-Identifier: Apache-2.0
// A device with a scene on it, ready to render to files.
#pragma once

#include <memory>
#include <optional>

#include "runtime/gpu/device.h"
#include "runtime/render/loaded_scene.h"
#include "runtime/render/progressive_renderer.h"
#include "runtime/scene/render_settings.h"
#include "runtime/session/options.h"
#include "runtime/session/report.h"

namespace pointrt {

/// What lives on the device, freed in order however the run ends.
struct RenderSession {
    Device device;
    std::optional<PassProfile> profile; ///< where options want it
    std::unique_ptr<LoadedScene> loaded;
    std::optional<ProgressiveRenderer> renderer; ///< of loaded
    RenderSettings settings;                     ///< loaded's, with what the files are to hold
    Camera camera;

    explicit RenderSession(const Options& options);
    RenderSession(const RenderSession&) = delete;
    RenderSession& operator=(const RenderSession&) = delete;
    ~RenderSession();
};

/// Puts description on the device with what options say, and notes both in report. Throws Error as resolveSettings and
/// loadScene do.
void loadSession(RenderSession& session, SceneDescription description, const Options& options, Report& report);

/// Frees what it takes to trace, when the last sample is taken: what comes then takes as much memory again.
void dropRenderer(RenderSession& session);

} // namespace pointrt
