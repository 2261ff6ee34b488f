// SPDX-License-Identifier: Apache-2.0
// Videos of moving cameras: pictures in a folder beside the video, which ffmpeg encodes.
#pragma once

#include <cstdint>
#include <string>

#include "runtime/session/options.h"

namespace pointrt {

/// The path of ffmpeg, to be called before long work. Throws Error kCannotRun if PATH has none.
std::string findEncoder(const std::string& video);

/// Makes the folder of options.output, the pictures of options.video, without the pictures of an earlier run. Throws
/// Error kCannotWrite "PATH: reason".
void prepareVideo(const Options& options);

/// Encodes all pictures and deletes them. If that fails they remain: throws Error kCannotRun with ffmpeg's words and
/// their folder. If interrupted they remain, too.
void encodeVideo(const Options& options, const std::string& encoder);

} // namespace pointrt
