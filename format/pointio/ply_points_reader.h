// SPDX-License-Identifier: Apache-2.0
// Reads points of PLY files.
#pragma once

#include <memory>
#include <string>

#include "format/os/mapped_file.h"
#include "format/pointio/point_reader.h"

namespace pointrt {

/// Columns are normals (nx ny nz), radius, colours (red green blue, as bytes), then every other property as an
/// attribute of its type. Reads all vertices once for the bounds. Throws as openPointReader does.
/// @param path for messages
std::unique_ptr<PointReader> readPlyPoints(const std::string& path, std::unique_ptr<format::MappedFile> file);

} // namespace pointrt
