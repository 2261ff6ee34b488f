// SPDX-License-Identifier: Apache-2.0
// Keeps cached bakes that scene files name: the cache may delete its own files at any time.
#pragma once

#include "runtime/device_scene/file_cache.h"
#include "runtime/scene/scene_description.h"

namespace pointrt {

/// For each cached bake that scene names, creates a file in the current folder, named after the scan: statue.pro for
/// statue.ply, or statue-1.pro and so on if that name is taken by another file. Throws Error kCannotWrite.
void keepBakes(SceneDescription& scene, const FileCache& cache);

} // namespace pointrt
