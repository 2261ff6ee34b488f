// SPDX-License-Identifier: GPL-3.0-or-later
// Points and triangles of glTF files.
#pragma once

#include "preprocess/ingest/sink.h"
#include "preprocess/input/mesh/gltf_scene.h"

namespace pointrt {

/// The shapes that a primitive draws.
enum class GltfShape { kPoints, kLines, kTriangles };

GltfShape gltfShape(const GltfPart& part);

/// Reads all parts, which must be points or must be triangles, as one scan.
/// @param title of the scan, or ""
void readGltfParts(const GltfFile& file, const std::vector<GltfPart>& parts, const std::string& title, Sink& sink);

} // namespace pointrt
