// SPDX-License-Identifier: Apache-2.0
// The camera as pointrt-view options: the text that Ctrl+C copies renders the same view on a command line.
#pragma once

#include <string>

#include "runtime/window/input/view_camera.h"

namespace pointrt {

/// "--eye X,Y,Z --target X,Y,Z --up X,Y,Z --fov DEG", or "--ortho HEIGHT" instead of --fov; round-trips exactly.
std::string cameraText(const ViewCamera& view);

/// Applies text to view: the options above in any order, with any white space between them and after commas. --eye and
/// --target are required; other missing options leave view unchanged. If the new direction is along view's up axis,
/// --up rolls the picture but does not change the axis. Throws Error kBadInput "camera text: reason".
ViewCamera withCameraText(const ViewCamera& view, const std::string& text);

} // namespace pointrt
