// SPDX-License-Identifier: Apache-2.0
// The readers of camera lists, one per format. readCameraList checks the cameras they return.
#pragma once

#include "runtime/scene_io/camera_list.h"

namespace pointrt {

/// none: unused, as there is no second file.
std::vector<CameraShot> readTransforms(const std::string& path, const std::string& none,
                                       const CameraFileRequest& request);
std::vector<CameraShot> readColmapBinary(const std::string& images, const std::string& cameras,
                                         const CameraFileRequest& request);
std::vector<CameraShot> readColmapText(const std::string& images, const std::string& cameras,
                                       const CameraFileRequest& request);

} // namespace pointrt
