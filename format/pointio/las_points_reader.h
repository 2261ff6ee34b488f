// SPDX-License-Identifier: Apache-2.0
// Reads points of LAS and LAZ files.
#pragma once

#include <memory>
#include <string>

#include "format/os/mapped_file.h"
#include "format/pointio/point_reader.h"

namespace pointrt {

/// Columns are all fields of the point format and the extra bytes, named as in laspy. Throws as openPointReader does.
/// @param path for messages
std::unique_ptr<PointReader> readLasPoints(const std::string& path, std::unique_ptr<format::MappedFile> file);

} // namespace pointrt
