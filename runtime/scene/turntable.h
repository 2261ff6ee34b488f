// SPDX-License-Identifier: Apache-2.0
// Pictures from all around: where the camera stands for each, and what its file is called.
#pragma once

#include <cstdint>
#include <string>

#include "runtime/scene/render_settings.h"

namespace pointrt {

constexpr std::uint32_t kMaxTurntable = 100000;

/// What the camera goes around.
struct TurntableAxis {
    Vec3 pivot; ///< a point of it, input coordinates
    Vec3 up;    ///< unit length
};

/// camera turned about axis by frame of frames steps of a full turn, counterclockwise seen from above. Frame 0 is
/// camera itself, to the bit. frame < frames.
Camera turntableCamera(const Camera& camera, const TurntableAxis& axis, std::uint32_t frame, std::uint32_t frames);

/// Refuses a path without exactly one %d or %0Nd (N from 1 to 9) for a turntable, and one with it for anything else.
/// Throws Error kBadUsage "PATH: reason".
void requireFrameNames(const std::string& path, bool turntable);

/// pattern, which requireFrameNames has let pass, with frame in the place of its %0Nd.
std::string frameName(const std::string& pattern, std::uint32_t frame);

} // namespace pointrt
