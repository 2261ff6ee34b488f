// SPDX-License-Identifier: Apache-2.0
// What becomes of scans that are dropped on the window: the .pro beside them, baked where it is not there yet.
#pragma once

#include <string>
#include <vector>

namespace pointrt {

struct BakePlan {
    std::vector<std::string> inputs;
    std::string output;         ///< the .pro
    bool is_up_to_date = false; ///< baked from these inputs as they are now: it need only be opened
};

/// Beside the first input and named after it: statue.pro for statue.ply. Nothing is ever overwritten: where that is
/// something else, or older than an input, it is statue.1.pro and so on. Throws Error kBadInput where an input is
/// no file, kCannotWrite where its folder cannot be written.
BakePlan planBake(const std::vector<std::string>& inputs);

/// The path of pointrt-bake: in folder, else in one of search_path's (as PATH has them). Throws Error kCannotRun with
/// where it was looked for.
std::string findBakeTool(const std::string& folder, const std::string& search_path);
/// The same beside our own program, else in PATH.
std::string findBakeTool();

} // namespace pointrt
