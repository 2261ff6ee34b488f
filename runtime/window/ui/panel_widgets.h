// SPDX-License-Identifier: Apache-2.0
// Rows of the panel: a label on the left, a widget on the right. Each returns true when the user changes the value,
// which is then finite and in range; other values are displayed as they are. tip: shown when the cursor rests on the
// row; empty: none.
#pragma once

#include <span>
#include <string>

#include "runtime/scene/scene_description.h"

namespace pointrt {

struct SliderRange {
    double low = 0, high = 1;
    bool logarithmic = false;
};

bool sliderRow(const char* name, float& value, SliderRange range, const char* format, const char* tip = "");
bool sliderRow(const char* name, double& value, SliderRange range, const char* format, const char* tip = "");
bool sliderRow(const char* name, std::uint32_t& value, SliderRange range, const char* tip = "");
/// step: change per window unit of dragging.
bool dragRow(const char* name, double& value, SliderRange range, double step, const char* format, const char* tip = "");
/// x, y and z below their label. size: of the scene, for steps and digits. unit: shown in the label; may be empty.
bool pointRow(const char* name, Vec3& point, double size, const std::string& unit, const char* tip = "");
/// color: linear, 0 to 1; displayed and typed as sRGB.
bool colorRow(const char* name, Color& color, const char* tip = "");
bool checkboxRow(const char* name, bool& value, const char* tip = "");
/// Linear to sRGB, clamped to 0 to 1.
Color encodedColor(const Color& linear);
/// chosen: index in names; blank if it is out of range.
bool comboRow(const char* name, int& chosen, std::span<const char* const> names, const char* tip = "");
bool textRow(const char* name, std::string& text, const char* hint, const char* tip = "");

/// Begins a row whose widget, labelled "##value", takes the right side. Pushes an id for the row until popRow.
void pushRow(const char* name, const char* tip);
void popRow();
/// A label with read-only text: beside it if it fits, else below, wrapped.
void valueRow(const char* name, const char* value);
/// A tooltip for the previous widget.
void tooltip(const char* tip);

/// A button that is 1 / share of the panel's width; highlighted if chosen.
bool columnButton(const char* name, int share, bool chosen = false, const char* tip = "");
/// Wrapped text in the disabled colour.
void dimText(const char* text);

} // namespace pointrt
