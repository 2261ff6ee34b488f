// SPDX-License-Identifier: Apache-2.0
// How the user interface looks.
#pragma once

namespace pointrt {

/// Height of a line of text at scale 1, in window units. Everything else is measured in it.
constexpr float kTextHeight = 15;

/// Sets fonts and style of the current ImGui context, which writes no files from then on. Again when a scale changes,
/// before the renderer takes the fonts.
/// content_scale: how large the user wants text on the screen, 1 on ordinary ones, about 2 on HiDPI; pixels_per_unit:
/// of the window's units. Both are brought into 0.5 to 4.
void setUpUiStyle(float content_scale, float pixels_per_unit = 1);

/// Window units in a unit of the design, from the current font.
float uiScale();

} // namespace pointrt
