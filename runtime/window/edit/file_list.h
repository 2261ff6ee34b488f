// SPDX-License-Identifier: Apache-2.0
// The scenes of a folder, for going from one to the next.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace pointrt {

/// Whether a comes before b as people sort: numbers in names by their value, img2 before img10.
bool naturallyLess(std::string_view a, std::string_view b);

/// Paths of the .pro and .toml files in folder (empty: the current one) in natural order, without hidden ones. Empty
/// where it cannot be read. A path is folder/name, or the bare name without a folder.
std::vector<std::string> sceneFiles(const std::string& folder);

/// The scene step files after path (before, where negative) in its folder, around the ends; path itself may be gone.
/// Empty where there is no other.
std::string neighbourFile(const std::string& path, int step);

} // namespace pointrt
