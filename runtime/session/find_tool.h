// SPDX-License-Identifier: Apache-2.0
// Finds the other pointrt programs, which the viewer starts.
#pragma once

#include <string>

namespace pointrt {

constexpr const char* kBakeTool = "pointrt-bake";
constexpr const char* kRaysTool = "pointrt-rays";

/// Finds a program in folder, or else in search_path (a list as in PATH). Throws Error kCannotRun, which lists the
/// places searched.
std::string findTool(const std::string& name, const std::string& folder, const std::string& search_path);
/// Searches beside the running program, then in PATH.
std::string findTool(const std::string& name);

} // namespace pointrt
