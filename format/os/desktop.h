// SPDX-License-Identifier: Apache-2.0
// The desktop that this process may open windows on, and its fonts.
#pragma once

#include <string>
#include <vector>

namespace pointrt {

/// Whether there is a desktop: whether $DISPLAY or $WAYLAND_DISPLAY is set. On Windows always true.
bool hasDesktop();

/// Files of sans serif fonts for a user interface, the best first. Any may be missing.
std::vector<std::string> interfaceFonts();

} // namespace pointrt
