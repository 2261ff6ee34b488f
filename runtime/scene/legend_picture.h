// SPDX-License-Identifier: Apache-2.0
// Legends drawn as pixels, for picture files.
#pragma once

#include "runtime/scene/legend.h"
#include "runtime/scene/overlay.h"

namespace pointrt {

/// Draws a legend for the lower left corner of a picture of this size, scaled with it.
OverlayBox drawLegend(const Legend& legend, PixelSize picture);

} // namespace pointrt
