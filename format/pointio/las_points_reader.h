// SPDX-License-Identifier: Apache-2.0
// Points of LAS and LAZ files.
#pragma once

#include <memory>
#include <string>

#include "format/base/mapped_file.h"
#include "format/pointio/point_reader.h"

namespace pointrt {

/// Columns: all fields of the point format and of the extra bytes, as laspy names them. Errors as openPointReader's.
/// @param path for messages
std::unique_ptr<PointReader> readLasPoints(const std::string& path, std::unique_ptr<format::MappedFile> file);

} // namespace pointrt
