// SPDX-License-Identifier: GPL-3.0-or-later
// The nodes of a glTF file: which primitives are where.
#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "preprocess/input/mesh/gltf_file.h"

namespace pointrt {

/// A primitive of a mesh where a node places it.
struct GltfPart {
    JsonValue primitive;
    Eigen::Affine3d input_from_part;

    /// The value of an extension of the primitive; nullopt if it has none of this name.
    std::optional<JsonValue> extension(const char* name) const;
};

/// The parts of the default scene or, if there are no scenes, of all nodes without a parent. Throws Error if a node has
/// two parents or is its own ancestor.
std::vector<GltfPart> gltfParts(const GltfFile& file);

} // namespace pointrt
