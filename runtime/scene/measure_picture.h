// SPDX-License-Identifier: Apache-2.0
// Measurements drawn over pictures.
#pragma once

#include <optional>
#include <span>

#include "runtime/scene/measure.h"
#include "runtime/scene/overlay.h"
#include "runtime/scene/render_settings.h"

namespace pointrt {

/// Where camera sees point in a picture of this size. None if it is beside or behind the eye. Not for panoramas.
std::optional<PixelPlace> placeInPicture(const Camera& camera, PixelSize size, Vec3 point);

/// Adds the lines, corners and labels of the visible measurements. Surfaces do not hide them. Panoramas show none.
void addMeasures(std::span<const MeasureDescription> measures, const MeasureUnits& units, const Camera& camera,
                 PixelSize size, PictureOverlay& overlay);

} // namespace pointrt
