// SPDX-License-Identifier: Apache-2.0
#include "format/pointio/point_sink.h"

#include "format/base/error.h"
#include "format/pointio/csv_points.h"
#include "format/pointio/e57_points.h"
#include "format/pointio/las_points.h"
#include "format/pointio/pcd_points.h"
#include "format/pointio/ply_points.h"

namespace pointrt {

PointFormat pointFormat(const std::string& path) {
    if (path == "-" || path.ends_with(".ply")) return PointFormat::kPly;
    if (path.ends_with(".las")) return PointFormat::kLas;
    if (path.ends_with(".laz")) return PointFormat::kLaz;
    if (path.ends_with(".csv")) return PointFormat::kCsv;
    if (path.ends_with(".pcd")) return PointFormat::kPcd;
    if (path.ends_with(".e57")) return PointFormat::kE57;
    throw Error(ExitCode::kBadUsage, path + ": points are written as .ply, .pcd, .las, .laz, .e57 or .csv");
}

std::unique_ptr<PointSink> openPointSink(const std::string& path, const PointOutline& outline,
                                         format::Existing existing) {
    const PointFormat format = pointFormat(path);
    PointFile file(path, existing);
    if (format == PointFormat::kCsv) return csvPoints(std::move(file), outline);
    if (format == PointFormat::kPcd) return pcdPoints(std::move(file), outline);
    if (format == PointFormat::kE57) return e57PointSink(std::move(file), outline);
    if (format == PointFormat::kPly) return plyPoints(std::move(file), outline);
    return lasPoints(std::move(file), outline, format == PointFormat::kLaz);
}

} // namespace pointrt
