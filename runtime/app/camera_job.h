// SPDX-License-Identifier: Apache-2.0
// Renders the pictures of a list of cameras into a folder.
#pragma once

#include <string>
#include <vector>

#include "runtime/scene_io/camera_list.h"
#include "runtime/session/options.h"
#include "runtime/session/render_session.h"
#include "runtime/session/report.h"

namespace pointrt {

/// A camera list, and the names of its pictures.
struct CameraPlan {
    std::vector<CameraShot> shots;
    std::vector<std::string> names; ///< shotNames
};

/// Reads options.cameras, creates the folder options.output, and sets options' picture size to that of the first
/// picture, for the session. Unless quiet, warns on standard error if distortion is dropped. Throws Error kBadInput as
/// readCameraList and shotNames do, kBadUsage if --size contradicts the list or the list would be overwritten,
/// kCannotWrite.
CameraPlan planCameras(Options& options);

/// Renders the plan's pictures one by one, then writes transforms.json with the finished ones. Throws Error kBadInput
/// "PLACE: reason" for a camera too far from the scene, else as CameraSeries and writeCameraFiles do.
void renderCameras(RenderSession& session, const CameraPlan& plan, const Options& options, Report& report);

} // namespace pointrt
