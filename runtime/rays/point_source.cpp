// SPDX-License-Identifier: Apache-2.0
#include "runtime/rays/point_source.h"

#include <algorithm>
#include <filesystem>
#include <system_error>

#include "format/base/require_pro.h"
#include "runtime/rays/file_points.h"
#include "runtime/rays/listed_points.h"
#include "runtime/rays/scene_points.h"
#include "runtime/scene_io/scene_file.h"

namespace pointrt {
namespace {

/// Null for files that PointReader cannot read, and for pipes, whose first bytes must not be consumed.
std::unique_ptr<PointReader> readerOf(const std::string& file) {
    std::error_code ignored;
    const bool has_bytes = std::filesystem::is_regular_file(file, ignored) && std::filesystem::file_size(file, ignored);
    return has_bytes ? openPointReader(file) : nullptr;
}

} // namespace

bool isReplaced(const PointColumn& column, const std::vector<std::string>& names) {
    return column.role == PointRole::kAttribute && std::find(names.begin(), names.end(), column.name) != names.end();
}

std::unique_ptr<PointSource> openPoints(const std::string& file, const std::vector<std::string>& scene,
                                        const std::vector<std::string>& replaced) {
    if (file.empty()) return scenePoints(scene, replaced);
    if (file == "-") return listedPoints(file, sceneOutline(scene));
    if (isSceneOrSet(file) || beginsAsPro(file)) return scenePoints({file}, replaced);
    if (auto reader = readerOf(file)) return filePoints(file, std::move(reader), sceneOutline(scene), replaced);
    return listedPoints(file, sceneOutline(scene));
}

} // namespace pointrt
