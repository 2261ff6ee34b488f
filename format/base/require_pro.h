// SPDX-License-Identifier: Apache-2.0
// What to say to who gives a scan, a picture or a folder to a tool that takes .pro files.
#pragma once

#include <string>

namespace pointrt {

/// Whether path is a file that begins as .pro files do. It need not be a good one.
bool beginsAsPro(const std::string& path);

/// Throws Error kBadInput where path is a folder, or a file that is something else than a .pro file: what it looks
/// like, and the command that makes a .pro of it. Says nothing of what is missing, cannot be read, or is just broken:
/// that is up to who reads it.
/// @param aside follows "bake it first", such as ", as the window does"
void requirePro(const std::string& path, const std::string& aside = "");

} // namespace pointrt
