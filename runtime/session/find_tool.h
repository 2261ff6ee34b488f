// SPDX-License-Identifier: Apache-2.0
// Finds pointrt-bake, which turns scans into .pro files.
#pragma once

#include <string>

namespace pointrt {

constexpr const char* kBakeTool = "pointrt-bake";

/// Finds pointrt-bake in folder, or else in search_path (a list as in PATH). Throws Error kCannotRun, which lists the
/// places searched.
std::string findBakeTool(const std::string& folder, const std::string& search_path);
/// Searches beside the running program, then in PATH.
std::string findBakeTool();

} // namespace pointrt
