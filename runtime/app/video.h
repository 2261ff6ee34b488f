// SPDX-License-Identifier: Apache-2.0
// Videos of moving cameras: pictures in a folder beside the video, which ffmpeg encodes.
#pragma once

#include <cstdint>
#include <string>

#include "runtime/session/options.h"

namespace pointrt {

/// The path of ffmpeg. Call it before rendering, so that a missing ffmpeg is reported at once. Throws Error kCannotRun
/// if ffmpeg is not in PATH.
std::string findEncoder(const std::string& video);

/// Creates the folder of options.output for the pictures of options.video, and deletes the pictures of an earlier run.
/// Throws Error kCannotWrite "PATH: reason".
void prepareVideo(const Options& options);

/// Encodes all pictures, then deletes them. If encoding fails, keeps them and throws Error kCannotRun with ffmpeg's
/// message and their folder. If interrupted, keeps them too.
void encodeVideo(const Options& options, const std::string& encoder);

} // namespace pointrt
