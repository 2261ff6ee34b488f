// SPDX-License-Identifier: Apache-2.0
// Radiance RGBE pictures (.hdr): "Radiance File Formats" by Greg Ward, section on the picture file format.
#pragma once

#include <string>

#include "runtime/image/image_read.h"

namespace pointrt {

/// Throws Error kBadInput "PATH: reason", also for truncated files and pictures that exceed pictureRoom.
FloatImage readRadiance(const std::string& path);

} // namespace pointrt
