// SPDX-License-Identifier: Apache-2.0
// From a scene and a list of cameras to a folder of pictures.
#pragma once

#include <string>
#include <vector>

#include "runtime/scene_io/camera_list.h"
#include "runtime/session/options.h"
#include "runtime/session/render_session.h"
#include "runtime/session/report.h"

namespace pointrt {

/// A list, and what its pictures are called.
struct CameraPlan {
    std::vector<CameraShot> shots;
    std::vector<std::string> names; ///< shotNames
};

/// Reads options.cameras, makes the folder options.output, and gives options the size of the first picture, so that the
/// session has the room for it. Says on standard error, unless it is to be quiet, that distortion was dropped.
/// Throws Error kBadInput as readCameraList and shotNames do, kBadUsage where --size contradicts the list or the list
/// would be written over, kCannotWrite.
CameraPlan planCameras(Options& options);

/// Renders the plan's pictures one by one, and then writes transforms.json with those that are there: all, but where it
/// was interrupted. Throws Error kBadInput "PLACE: reason" for a camera too far from the scene, else as CameraSeries
/// and writeCameraFiles do.
void renderCameras(RenderSession& session, const CameraPlan& plan, const Options& options, Report& report);

} // namespace pointrt
