// SPDX-License-Identifier: Apache-2.0
// The scenes of a folder, to step through them.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace pointrt {

/// Natural sort order: numbers in names compare by value, img2 before img10.
bool naturallyLess(std::string_view a, std::string_view b);

/// Paths of the .pro and .toml files in folder (empty: the current one), in natural order, without hidden files. Empty
/// if the folder cannot be read. Paths are folder/name, or just the name without a folder.
std::vector<std::string> sceneFiles(const std::string& folder);

/// The scene step files after path (before it, if negative) in its folder, wrapping around. path itself may have been
/// deleted. Empty if there is no other scene.
std::string neighbourFile(const std::string& path, int step);

} // namespace pointrt
