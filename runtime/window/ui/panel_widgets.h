// SPDX-License-Identifier: Apache-2.0
// Rows of the panel: a name on the left, a value to change on the right. Each returns true in a frame in which the user
// changed the value, which then is finite and in range; values from elsewhere are shown as they are. tip: shown while
// the cursor rests on the row; empty: none.
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
/// step: how much it changes for each window unit that the cursor goes.
bool dragRow(const char* name, double& value, SliderRange range, double step, const char* format, const char* tip = "");
/// x, y and z, under their name. size: of the scene, for steps and digits.
bool pointRow(const char* name, Vec3& point, double size, const char* tip = "");
/// color: linear, 0 to 1; shown and typed as sRGB.
bool colorRow(const char* name, Color& color, const char* tip = "");
bool checkboxRow(const char* name, bool& value, const char* tip = "");
/// Linear to sRGB; what is out of range is brought into it.
Color encodedColor(const Color& linear);
/// One of names, by number; a chosen that is none of them shows as a blank.
bool comboRow(const char* name, int& chosen, std::span<const char* const> names, const char* tip = "");
bool textRow(const char* name, std::string& text, const char* hint, const char* tip = "");

/// Begins a row: what follows, with the label "##value", takes the right side. Between pushRow and popRow ids are the
/// row's own.
void pushRow(const char* name, const char* tip);
void popRow();
/// A name and words that cannot be changed, wrapped.
void valueRow(const char* name, const char* value);
/// The tip for the widget before.
void tooltip(const char* tip);

/// A button that is 1 / share of the panel wide; chosen ones are lit.
bool columnButton(const char* name, int share, bool chosen = false, const char* tip = "");
/// Dim, wrapped.
void dimText(const char* text);

} // namespace pointrt
