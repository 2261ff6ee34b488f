// SPDX-License-Identifier: Apache-2.0
// Points of PLY files.
#pragma once

#include <memory>
#include <string>

#include "format/base/mapped_file.h"
#include "format/pointio/point_reader.h"

namespace pointrt {

/// The vertices. Columns: normals (nx ny nz), radius, colours (red green blue, as bytes), then every other property as
/// an attribute of its type. Looks at all of them once, for the bounds. Errors as openPointReader's.
/// @param path for messages
std::unique_ptr<PointReader> readPlyPoints(const std::string& path, std::unique_ptr<format::MappedFile> file);

} // namespace pointrt
