// SPDX-License-Identifier: Apache-2.0
// Names of output files for the pictures of a camera list.
#pragma once

#include <string>
#include <vector>

#include "runtime/scene_io/camera_list.h"

namespace pointrt {

/// A unique relative path for each shot, without a suffix: its name in the list without the folders common to all, the
/// image suffix, and parts that would lead out of the output folder ("/", "..").
/// Throws Error kBadInput "PLACE: reason" for names with control characters and duplicate paths.
std::vector<std::string> shotNames(const std::vector<CameraShot>& shots);

} // namespace pointrt
