// SPDX-License-Identifier: Apache-2.0
// Where to bake the scans that are dropped on the window, and whether they have been baked before.
#pragma once

#include <string>
#include <vector>

namespace pointrt {

struct BakePlan {
    std::vector<std::string> inputs;
    std::string output;         ///< the .pro
    bool is_up_to_date = false; ///< already baked from the current inputs: only needs opening
};

/// The output is beside the first input and named after it: statue.pro for statue.ply. Never overwrites a file: if
/// statue.pro is something else or older than an input, the output is statue.1.pro and so on. Throws Error kBadInput if
/// an input is not a file, kCannotWrite if the folder is not writable.
BakePlan planBake(const std::vector<std::string>& inputs);

/// Finds pointrt-bake in folder, or else in search_path (a list as in PATH). Throws Error kCannotRun, which lists the
/// places searched.
std::string findBakeTool(const std::string& folder, const std::string& search_path);
/// Searches beside the running program, then in PATH.
std::string findBakeTool();

} // namespace pointrt
