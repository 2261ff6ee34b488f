// SPDX-License-Identifier: Apache-2.0
#include "format/info/export_points.h"

#include <algorithm>
#include <memory>

#include "format/pointio/point_sink.h"
#include "format/pointio/pro_points.h"

namespace pointrt {
namespace {

constexpr std::size_t kSplatsAtOnce = 16384; // takes some MiB for columns

/// CloudCompare shows properties with this prefix as scalar fields, without the prefix.
void prefixAttributes(PointOutline& outline) {
    for (PointColumn& column : outline.columns)
        if (column.role == PointRole::kAttribute) column.name = "scalar_" + column.name;
}

} // namespace

void exportPoints(const ExportSource& source, const std::string& path, bool overwrite, bool scalar_names) {
    PointOutline outline = source.outline;
    outline.program = "pointrt-info " POINTRT_VERSION;
    outline.comment = "splats of a .pro file: oriented discs";
    if (scalar_names && pointFormat(path) == PointFormat::kPly) prefixAttributes(outline);
    const auto existing = overwrite ? format::Existing::kReplaced : format::Existing::kKept;
    const std::unique_ptr<PointSink> sink = openPointSink(path, outline, existing);
    PointBlock block;
    source.forEachPart([&](const ProFile& file, std::span<const std::uint32_t> splats) {
        for (std::size_t first = 0; first < splats.size(); first += kSplatsAtOnce) {
            const std::size_t count = std::min(kSplatsAtOnce, splats.size() - first);
            gatherPoints(file, splats.subspan(first, count), source.outline.columns, block);
            sink->add(block);
        }
    });
    sink->finish();
}

} // namespace pointrt
