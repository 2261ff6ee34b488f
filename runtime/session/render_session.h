// SPDX-License-Identifier: Apache-2.0
// A device with a scene on it, ready to render to files.
#pragma once

#include <optional>

#include "runtime/device_scene/device_scene.h"
#include "runtime/gpu/device.h"
#include "runtime/scene/render_settings.h"
#include "runtime/session/options.h"
#include "runtime/session/report.h"
#include "runtime/tracer/tracer.h"

namespace pointrt {

/// What lives on the device, freed in order however the run ends.
struct RenderSession {
    Device device;
    std::optional<DeviceScene> scene;
    std::optional<Tracer> tracer;
    RenderSettings settings;
    Camera camera; ///< the tracer's

    explicit RenderSession(const Options& options);
    RenderSession(const RenderSession&) = delete;
    RenderSession& operator=(const RenderSession&) = delete;
    ~RenderSession();
};

/// Puts description on the device with what options say, and notes both in report. Throws Error as openScene,
/// frameCamera and resolveSettings do.
void loadSession(RenderSession& session, SceneDescription description, const Options& options, Report& report);

} // namespace pointrt
