// SPDX-License-Identifier: Apache-2.0
// The files of a picture from a list of cameras: a layer each, in the units that machines are trained with.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "runtime/image/film.h"
#include "runtime/scene/pinhole.h"
#include "runtime/session/options.h"

namespace pointrt {

/// What a folder of pictures is made of.
struct CameraFiles {
    std::string folder;
    CameraOutput output;
    double depth_unit = 0; ///< of a depth's whole numbers
    float exposure = 0;    ///< stops, of rgb and albedo
};

/// Keys of transforms.json and the files that they name, relative to the folder, for a picture of this name.
std::vector<std::pair<std::string, std::string>> fileNames(const CameraOutput& output, const std::string& name);

/// Writes film, which has first hits and, for .exr, the parts of the light, to these files, one after the other, each
/// all or nothing. Returns how many pixels are farther than depth's numbers tell, which are 0 as where nothing is.
/// Throws Error kCannotWrite "PATH: reason".
std::uint64_t writeCameraFiles(const CameraFiles& files, const std::string& name, const PinholeLens& lens,
                               const Film& film);

/// A depth along the viewing axis in whole units, rounded, from that along the ray through the centre of pixel (x, y):
/// 0 for nothing, for what is nearer than half a unit and farther than 65535.
std::uint16_t depthNumber(float along_ray, const PinholeLens& lens, std::uint32_t x, std::uint32_t y, double unit);

} // namespace pointrt
