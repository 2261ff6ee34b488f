// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace pointrt {

/// The path of a program, by its name without .exe, in the folders of search_path (as PATH has them); empty if none has
/// it.
std::string findProgram(const std::string& name, const std::string& search_path);

} // namespace pointrt
