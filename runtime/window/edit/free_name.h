// SPDX-License-Identifier: Apache-2.0
// Unused names for files the window writes.
#pragma once

#include <string>
#include <vector>

namespace pointrt {

/// The name that files made from path begin with: "statue" for statue.ply and for the folder statue/; "picture" if path
/// is empty.
std::string stemOf(const std::string& path);

/// "statue-1", with the first number for which the working directory has no file with one of the endings. Throws
/// Error kCannotWrite if all numbers up to 9999 are taken.
std::string freeName(const std::string& path, const std::vector<std::string>& endings);

} // namespace pointrt
