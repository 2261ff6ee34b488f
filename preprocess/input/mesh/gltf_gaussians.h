// SPDX-License-Identifier: GPL-3.0-or-later
// Gaussians in glTF files: KHR_gaussian_splatting, and drafts that hold an SPZ file.
#pragma once

#include "preprocess/ingest/sink.h"
#include "preprocess/input/mesh/gltf_scene.h"

namespace pointrt {

/// Whether a primitive's points are Gaussians.
bool areGaussians(const GltfPart& part);

/// Reads all parts, which must be of Gaussians, as one scan. Throws Error as readGaussianScan does.
/// @param title of the scan, or ""
void readGltfGaussians(const GltfFile& file, const std::vector<GltfPart>& parts, const std::string& title, Sink& sink);

} // namespace pointrt
