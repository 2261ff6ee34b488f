// SPDX-License-Identifier: Apache-2.0
#include "format/pointio/point_reader.h"

#include <string_view>

#include "format/base/error.h"
#include "format/os/mapped_file.h"
#include "format/pointio/las_points_reader.h"
#include "format/pointio/ply_points_reader.h"

namespace pointrt {

std::unique_ptr<PointReader> openPointReader(const std::string& path) {
    auto file = std::make_unique<format::MappedFile>();
    if (!file->map(path.c_str()))
        throw Error(file->outOfMemory() ? ExitCode::kCannotRun : ExitCode::kBadInput, path + ": " + file->error());
    const std::string_view bytes(reinterpret_cast<const char*>(file->bytes().data()), file->bytes().size());
    if (bytes.starts_with("LASF")) return readLasPoints(path, std::move(file));
    if (bytes.starts_with("ply\n") || bytes.starts_with("ply\r")) return readPlyPoints(path, std::move(file));
    return nullptr;
}

} // namespace pointrt
