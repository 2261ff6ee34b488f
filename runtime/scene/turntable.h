// SPDX-License-Identifier: Apache-2.0
// Turntables: the camera and the file name of each picture.
#pragma once

#include <cstdint>
#include <string>

#include "runtime/scene/render_settings.h"

namespace pointrt {

constexpr std::uint32_t kMaxTurntable = 100000;

/// The axis of the camera's rotation.
struct TurntableAxis {
    Vec3 pivot; ///< a point on the axis, input coordinates
    Vec3 up;    ///< unit length
};

/// camera rotated about axis by frame / frames of a full turn, counterclockwise seen from above. Frame 0 is
/// bit-identical to camera. frame < frames.
Camera turntableCamera(const Camera& camera, const TurntableAxis& axis, std::uint32_t frame, std::uint32_t frames);

/// Checks that path has exactly one %d or %0Nd (N from 1 to 9) if option, such as "--turntable", requests several
/// pictures, and none if option is null. Throws Error kBadUsage "PATH: reason".
void requireFrameNames(const std::string& path, const char* option);

/// pattern with its %d or %0Nd replaced by frame. pattern: checked by requireFrameNames
std::string frameName(const std::string& pattern, std::uint32_t frame);

} // namespace pointrt
