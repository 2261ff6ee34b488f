// SPDX-License-Identifier: Apache-2.0
// Names for files that the window writes beside others.
#pragma once

#include <string>
#include <vector>

namespace pointrt {

/// "statue-1", the first number for which there is no file with one of the endings in the working directory; stem is
/// that of path, or "picture" where it has none. Throws Error kCannotWrite where there are 9999 of them.
std::string freeName(const std::string& path, const std::vector<std::string>& endings);

} // namespace pointrt
