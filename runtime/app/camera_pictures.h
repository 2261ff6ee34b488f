// SPDX-License-Identifier: Apache-2.0
// The output files of --cameras: one per layer.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "runtime/image/film.h"
#include "runtime/image/tonemap.h"
#include "runtime/scene/pinhole.h"
#include "runtime/session/options.h"

namespace pointrt {

/// Where and how to write pictures.
struct CameraFiles {
    std::string folder;
    CameraOutput output;
    double depth_unit = 0; ///< scene units per step of depth pictures
    ToneMapping tone;      ///< tone mapping of rgb; albedo uses only its exposure
};

/// The entries of transforms.json for a picture of this name: keys, and paths of files relative to the folder.
std::vector<std::pair<std::string, std::string>> fileNames(const CameraOutput& output, const std::string& name);

/// Writes the layers of film to their files, each atomically. film must have first hits, and for .exr also light
/// components. Returns the number of pixels whose depth is out of range; they are written as 0, like misses. Throws
/// Error kCannotWrite "PATH: reason".
std::uint64_t writeCameraFiles(const CameraFiles& files, const std::string& name, const PinholeLens& lens,
                               const Film& film);

/// The depth along the viewing axis, rounded to multiples of unit. along_ray: distance along the ray through the centre
/// of pixel (x, y). 0 for a miss, and for depths below half a unit or above 65535 units.
std::uint16_t depthNumber(float along_ray, const PinholeLens& lens, std::uint32_t x, std::uint32_t y, double unit);

} // namespace pointrt
