// SPDX-License-Identifier: Apache-2.0
// The parts of a scene as one list: what can be named, hidden, locked and deleted.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "runtime/scene/scene_description.h"

namespace pointrt {

enum class LayerKind : std::uint8_t { kScan, kShape, kLight, kClip, kMeasure };

/// A part of a scene: the number is its index among those of its kind.
struct LayerId {
    LayerKind kind = LayerKind::kScan;
    std::size_t number = 0;
    bool operator==(const LayerId&) const = default;
};

/// All parts, scans first, without deleted ones.
std::vector<LayerId> layersOf(const SceneDescription& scene);

/// The part's name; if it has none, the file name of a scan, else kind and number from 1, such as "light 2".
std::string layerName(const SceneDescription& scene, LayerId id);
/// The first layer with this name.
std::optional<LayerId> layerNamed(const SceneDescription& scene, const std::string& name);

Layer& layerAt(SceneDescription& scene, LayerId id);
const Layer& layerAt(const SceneDescription& scene, LayerId id);
bool isLayerVisible(const SceneDescription& scene, LayerId id);
/// A hidden clip cuts nothing; a hidden measurement is not drawn.
void setLayerVisible(SceneDescription& scene, LayerId id, bool visible);

/// Numbers of the shapes that are not hidden, in the order of their rows on the device.
std::vector<std::size_t> shownShapes(const SceneDescription& scene);

/// Whether a shape, with a material of its own, can be added; lights with a surface count as shapes.
bool mayAddShape(const SceneDescription& scene);

/// False for locked layers, and for the last scan or shape, since a scene needs one.
bool mayDelete(const SceneDescription& scene, LayerId id);
/// Deletes a layer. The numbers of later layers of its kind change, except for scans.
void deleteLayer(SceneDescription& scene, LayerId id);

/// Hides the layers with these names. Throws Error kBadUsage "--hide: ..." for a name that no layer has.
void hideLayers(SceneDescription& scene, const std::vector<std::string>& names);

} // namespace pointrt
