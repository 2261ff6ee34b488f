// SPDX-License-Identifier: Apache-2.0
// Lengths, areas and positions as text, with the scene's unit if it is known.
#pragma once

#include <string>

#include "runtime/window/edit/workspace.h"

namespace pointrt {

/// "12.345 m"; decimals resolve 1e-4 of size.
std::string shownLength(const Workspace& w, double value, double size);
/// "1.250 m2"; decimals resolve 1e-4 of the square of size.
std::string shownArea(const Workspace& w, double value, double size);
/// "1.0  2.0  3.0 m"
std::string shownPoint(const Workspace& w, Vec3 point, double size);
/// A format for lengths: number, such as "%.4g", followed by the unit.
std::string lengthFormat(const Workspace& w, const char* number);

} // namespace pointrt
