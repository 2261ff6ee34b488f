// SPDX-License-Identifier: Apache-2.0
// The identity of a bake: equal keys mean equal results.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace pointrt {

/// Scans to bake into one scene.
struct ScanBake {
    std::vector<std::string> scans;   ///< files and folders, at least one
    std::vector<std::string> options; ///< of pointrt-bake
};

/// The options of a quick bake: every n-th point, without cleaning and pruning, in about a tenth of the time. None for
/// scans so small that their full bake takes about a second.
std::optional<ScanBake> quickBake(const ScanBake& bake);

/// 32 hexadecimal digits that depend on the names and contents of the scans, on the options and the files that options
/// name, and on the version of the tool. For formats that refer to other files (OBJ, .conf, glTF, ...), they also
/// depend on the names, sizes and times of the files around the scan. "" if cancelled() becomes true while files are
/// read. Throws Error kBadInput if a scan cannot be read.
/// @param tool path of pointrt-bake
std::string bakeKey(const ScanBake& bake, const std::string& tool, const std::function<bool()>& cancelled);

} // namespace pointrt
