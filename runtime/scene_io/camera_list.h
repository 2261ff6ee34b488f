// SPDX-License-Identifier: Apache-2.0
// Cameras of a list, one for each picture, in the scan's coordinates, whichever file they come from.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "runtime/scene/pinhole.h"

namespace pointrt {

struct CameraShot {
    std::string name;  ///< of its picture in the list, such as "images/0001.jpg"
    std::string place; ///< where the list has it, to begin messages with: "FILE:LINE: " or "FILE: frame 3: "
    PixelSize size;
    PinholeLens lens;
    CameraPose pose;
    std::string distortion; ///< of a lens that has any: what the list says of it
};

struct CameraFileRequest {
    /// Of pictures where the list tells no size, as some transforms.json do not.
    std::optional<PixelSize> size;
    bool drops_distortion = false; ///< takes lenses as if they had none
};

/// Reads a list:
///  - transforms.json of nerfstudio, Instant-NGP and Blender's NeRF scenes: transform_matrix is world_from_camera, x to
///    the right, y up, z behind the camera; applied_transform, which nerfstudio has put before the world, is taken off;
///  - a folder with COLMAP's cameras.bin and images.bin, or cameras.txt and images.txt, or one of these files: their
///    poses are camera_from_world, quaternions w x y z, with OpenCV's axes.
/// Of a folder with several of these the first is taken: transforms.json, .bin, .txt; then those in its sparse/0.
/// Throws Error kBadInput "FILE: PLACE: reason" for what cannot be read or is none of these, lists without a camera,
/// lenses that are no pinholes, distortion that is not dropped, poses that are no rotation.
std::vector<CameraShot> readCameraList(const std::string& path, const CameraFileRequest& request);

} // namespace pointrt
