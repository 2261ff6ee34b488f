// SPDX-License-Identifier: Apache-2.0
// Programs: where they are, and what makes a file one.
#pragma once

#include <string>

namespace pointrt {

/// Path of the running program; empty if the system does not tell.
std::string programPath();

/// "pointrt-bake" as the name of a program's file: pointrt-bake.exe on Windows.
std::string programFile(const std::string& name);

/// Whether path is a file that this user may run.
bool isProgram(const std::string& path);

/// A path of Windows without its prefix \\?\, behind which it may not be joined by /. Elsewhere the path as it is.
std::string plainPath(const std::string& path);

/// Separates the folders of PATH.
extern const char kSearchPathSeparator;

} // namespace pointrt
