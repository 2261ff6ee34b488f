// SPDX-License-Identifier: Apache-2.0
// The one selected layer of all sections, and which layer has handles over the picture.
#pragma once

#include <optional>

#include "runtime/scene/layers.h"

namespace pointrt {

LayerId selectedLayer();
void selectLayer(LayerId id);

/// Call it in a section that shows the values of this layer in this frame. If the layer is selected, it gets handles.
void offerHandles(LayerId id);
/// The layer with handles in this frame. Call it after the panel.
std::optional<LayerId> layerWithHandles();

} // namespace pointrt
