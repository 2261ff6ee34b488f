// SPDX-License-Identifier: Apache-2.0
// A reader for each kind of list. They take what is there; readCameraList says what of it is no camera.
#pragma once

#include "runtime/scene_io/camera_list.h"

namespace pointrt {

/// There is no second file.
std::vector<CameraShot> readTransforms(const std::string& path, const std::string& none,
                                       const CameraFileRequest& request);
std::vector<CameraShot> readColmapBinary(const std::string& images, const std::string& cameras,
                                         const CameraFileRequest& request);
std::vector<CameraShot> readColmapText(const std::string& images, const std::string& cameras,
                                       const CameraFileRequest& request);

} // namespace pointrt
