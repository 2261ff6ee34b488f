// SPDX-License-Identifier: Apache-2.0
// Unused names for files the window writes.
#pragma once

#include <string>
#include <vector>

namespace pointrt {

/// "statue-1", with the first number for which the working directory has no file with one of the endings. The stem is
/// that of path, or "picture" if path is empty. Throws Error kCannotWrite if all numbers up to 9999 are taken.
std::string freeName(const std::string& path, const std::vector<std::string>& endings);

} // namespace pointrt
