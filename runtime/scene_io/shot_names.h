// SPDX-License-Identifier: Apache-2.0
// Names for a list's pictures, of our own files.
#pragma once

#include <string>
#include <vector>

#include "runtime/scene_io/camera_list.h"

namespace pointrt {

/// For each shot a relative path without a suffix, unlike all others: its name in the list without the folders that all
/// have in common, the suffix of an image, and what would lead out of a folder ("/", "..").
/// Throws Error kBadInput "PLACE: reason" where a name has control characters, or comes to another one's.
std::vector<std::string> shotNames(const std::vector<CameraShot>& shots);

} // namespace pointrt
