// SPDX-License-Identifier: Apache-2.0
// Sections: a plane that cuts a scene open, or a slice of it, and the view that looks at the cut in true scale.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "runtime/scene/clip.h"

namespace pointrt {

/// A plane perpendicular to an axis. A vertical section is viewed so that the other horizontal coordinate increases to
/// the right; a horizontal one is viewed from above, as a floor plan.
struct AxisSection {
    std::size_t axis = 0;  ///< 0, 1, 2: x, y, z
    double at = 0;         ///< world units
    bool reversed = false; ///< seen from the other side, keeping the other half
};

/// A vertical plane through two points of the plan; the first is on the left in the picture. Coordinates: x and y if
/// z is vertical, x and z if y is, y and z if x is.
struct LineSection {
    std::array<double, 2> from{}, to{};
};

/// A section as users give it; the up direction is known only once the scene is loaded.
struct SectionRequest {
    std::variant<AxisSection, LineSection> plane;
    /// Thickness of a slice, half on either side, above 0; nullopt: keeps everything behind the plane.
    std::optional<double> thickness;
};

/// "x=12.5", "-x=12.5", "z=1.2:0.5", "X0,Y0,X1,Y1" or "X0,Y0,X1,Y1:0.5". Throws std::invalid_argument with the reason
/// for any other text.
SectionRequest parseSection(const std::string& text);

struct Section {
    std::vector<ClipDescription> clips; ///< one plane, or the two of a slice
    Vec3 side, up;                      ///< unit vectors: from the cut to the eye, and up in the picture
};

/// @param up of the scene, unit length; the axis nearest to it is the vertical one
Section makeSection(const SectionRequest& request, Vec3 up);

} // namespace pointrt
