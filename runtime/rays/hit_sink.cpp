// SPDX-License-Identifier: Apache-2.0
#include "runtime/rays/hit_sink.h"

#include "format/base/error.h"
#include "runtime/rays/csv_sink.h"
#include "runtime/rays/npy_sink.h"
#include "runtime/rays/npz_sink.h"
#include "runtime/rays/ply_sink.h"

namespace pointrt {

SinkKind sinkKind(const SinkRequest& request) {
    const std::string& path = request.path;
    if (path == "-") return request.count ? SinkKind::kNpy : SinkKind::kCsv;
    if (path.ends_with(".npz")) return SinkKind::kNpz;
    if (path.ends_with(".npy")) return SinkKind::kNpy;
    if (path.ends_with(".csv")) return SinkKind::kCsv;
    if (!path.ends_with(".ply"))
        throw Error(ExitCode::kBadUsage,
                    path + ": hits are written as .npz, .npy, .csv or .ply, or to - (standard output)");
    if (request.any) throw Error(ExitCode::kBadUsage, path + ": --any has no points for PLY; use .npz, .npy or .csv");
    return SinkKind::kPly;
}

std::unique_ptr<HitSink> openSink(const SinkRequest& request, std::span<const HitColumn> columns) {
    switch (sinkKind(request)) {
    case SinkKind::kNpz:
        return npzSink(request.path, columns);
    case SinkKind::kNpy:
        return npySink(request, columns);
    case SinkKind::kCsv:
        return csvSink(request.path, columns);
    case SinkKind::kPly:
        break;
    }
    return plySink(request.path, columns);
}

} // namespace pointrt
