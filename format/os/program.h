// SPDX-License-Identifier: Apache-2.0
// Programs: their paths, and which files are programs.
#pragma once

#include <string>

namespace pointrt {

/// Path of the running program; empty if the system does not report it.
std::string programPath();

/// "pointrt-bake" as the name of a program's file: pointrt-bake.exe on Windows.
std::string programFile(const std::string& name);

/// Whether path is a file that this user may run.
bool isProgram(const std::string& path);

/// A Windows path without its prefix \\?\, after which / must not be used. On other systems the path is returned
/// unchanged.
std::string plainPath(const std::string& path);

/// Separates the folders of PATH.
extern const char kSearchPathSeparator;

} // namespace pointrt
