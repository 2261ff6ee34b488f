// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace pointrt {

/// Finds a program, given by its name without .exe, in the folders of search_path, which is a list like PATH; empty if
/// it is in none of them.
std::string findProgram(const std::string& name, const std::string& search_path);

} // namespace pointrt
