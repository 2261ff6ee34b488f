// SPDX-License-Identifier: Apache-2.0
// Fonts and colours of the user interface.
#pragma once

namespace pointrt {

/// Text height at scale 1, window units. All other sizes are relative to it.
constexpr float kTextHeight = 15;

/// Sets fonts and style of the current ImGui context, and stops it from writing files. Repeat when a scale changes,
/// before the renderer uploads the fonts.
/// content_scale: the desktop's text scale, 1 on ordinary screens, about 2 on HiDPI. pixels_per_unit: pixels per window
/// unit. Both are clamped to 0.5 to 4.
void setUpUiStyle(float content_scale, float pixels_per_unit = 1);

/// Dark or light colours; setUpUiStyle sets dark ones.
void setUiTheme(bool light);

/// Window units per design unit, from the current font.
float uiScale();

} // namespace pointrt
