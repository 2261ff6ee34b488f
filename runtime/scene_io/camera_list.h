// SPDX-License-Identifier: Apache-2.0
// Lists of calibrated cameras, one per picture, in the scan's coordinates, from any supported file.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "runtime/scene/pinhole.h"

namespace pointrt {

struct CameraShot {
    std::string name;  ///< of the picture in the list, such as "images/0001.jpg"
    std::string place; ///< of the shot in the list, begins messages: "FILE:LINE: " or "FILE: frame 3: "
    PixelSize size;
    PinholeLens lens;
    CameraPose pose;
    std::string distortion; ///< the lens's distortion as text; empty: none
};

struct CameraFileRequest {
    /// The size of pictures whose size is not in the list; some transforms.json have none.
    std::optional<PixelSize> size;
    bool drops_distortion = false; ///< ignore distortion instead of refusing it
};

/// Reads a list:
///  - transforms.json of nerfstudio, Instant-NGP and Blender's NeRF scenes: transform_matrix is world_from_camera, x to
///    the right, y up, z behind the camera; nerfstudio's applied_transform is undone;
///  - a folder with COLMAP's cameras.bin and images.bin, or cameras.txt and images.txt, or one of these files. Poses
///    are camera_from_world, quaternions w x y z, with OpenCV's axes.
/// In a folder with several of these, reads the first of transforms.json, .bin, .txt, then the same in sparse/0.
/// Throws Error kBadInput "FILE: PLACE: reason" for files that cannot be read or are of another format, empty lists,
/// lenses other than pinholes, distortion unless dropped, and poses that are not rotations.
std::vector<CameraShot> readCameraList(const std::string& path, const CameraFileRequest& request);

} // namespace pointrt
