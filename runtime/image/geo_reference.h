// SPDX-License-Identifier: Apache-2.0
// The position on the map of a plan, which is a picture seen from above.
#pragma once

#include <string>

namespace pointrt {

struct GeoReference {
    double pixel = 1;           ///< side of a pixel in units of the coordinates
    double west = 0, north = 0; ///< of the picture's upper left corner
    int epsg = 0;               ///< code of the projected coordinate system, 0: unknown
};

/// The text of a world file: six lines, which place the centre of the upper left pixel.
std::string worldFileText(const GeoReference& place);
/// "plan.pgw" for "plan.png".
std::string worldFilePath(const std::string& png_path);

} // namespace pointrt
