// SPDX-License-Identifier: Apache-2.0
// Advice for users who give a scan, a picture or a folder to a tool that takes .pro files.
#pragma once

#include <string>

namespace pointrt {

/// Whether path is a file with the magic bytes of a .pro. It need not be valid.
bool beginsAsPro(const std::string& path);

/// Throws Error kBadInput if path is a folder or a file of another kind, with that kind and the command that bakes it.
/// Leaves missing, unreadable and damaged files to the reader.
/// @param aside inserted after "bake it first", such as ", as the window does"
void requirePro(const std::string& path, const std::string& aside = "");

} // namespace pointrt
