// SPDX-License-Identifier: Apache-2.0
// The one selected layer of all sections, and which layer has handles over the picture.
#pragma once

#include <optional>

#include "runtime/scene/layers.h"

namespace pointrt {

LayerId selectedLayer();
void selectLayer(LayerId id);

/// A section shows the values of this layer in this frame. If it is the selected one, it gets handles.
void offerHandles(LayerId id);
/// The layer with handles in this frame. After the panel.
std::optional<LayerId> layerWithHandles();

} // namespace pointrt
