// SPDX-License-Identifier: GPL-3.0-or-later
// What a named or numbered column of a scan means.
#pragma once

#include <array>
#include <span>
#include <string_view>

namespace pointrt {

enum Role {
    kX,
    kY,
    kZ,
    kNormalX,
    kNormalY,
    kNormalZ,
    kRed,
    kGreen,
    kBlue,
    kRadius, ///< of a disc: no name means it by itself, readers of splats set it
    kRoleCount,
    kIgnored = kRoleCount
};

/// One vertex: a value per role, and one for what is ignored.
using Row = std::array<double, kRoleCount + 1>;

/// The role of a property, field or column name, whatever its case; kIgnored where it has none.
Role roleOfName(std::string_view name);

/// Keeps the first column of each role and makes later ones ignored, as well as incomplete normals and colours.
void settleRoles(std::span<Role> roles);

bool hasPositions(std::span<const Role> roles);
bool hasNormals(std::span<const Role> roles);
bool hasColors(std::span<const Role> roles);

} // namespace pointrt
