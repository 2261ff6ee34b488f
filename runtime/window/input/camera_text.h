// SPDX-License-Identifier: Apache-2.0
// The camera as the viewer's own options: what Ctrl+C copies renders the same view on a command line.
#pragma once

#include <string>

#include "runtime/window/input/view_camera.h"

namespace pointrt {

/// "--eye X,Y,Z --target X,Y,Z --up X,Y,Z --fov DEG", or "--ortho HEIGHT" in place of the last; the numbers are exact.
std::string cameraText(const ViewCamera& view);

/// view as text asks for: the options above in any order, with any white space between them and after commas; --eye and
/// --target must be there, what else is missing stays as it is. An --up where the view goes along view's axis turns the
/// picture and not the axis. Throws Error kBadInput "camera text: reason".
ViewCamera withCameraText(const ViewCamera& view, const std::string& text);

} // namespace pointrt
