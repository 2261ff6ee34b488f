// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/input/read.h"

#include <algorithm>

#include "preprocess/input/formats/detect.h"
#include "preprocess/input/mesh.h"

namespace pointrt {
namespace {

void readFiles(const std::vector<std::string>& paths, const ReadOptions& options, const ReadProgress& progress,
               Sink& sink) {
    for (std::size_t i = 0; i < paths.size(); ++i) {
        if (progress)
            sink.progress = [&, i](double share) {
                progress((static_cast<double>(i) + share) / static_cast<double>(paths.size()));
            };
        const Source source = openSource(paths[i]);
        formatOf(source, options.format).reader.read(source, sink);
    }
    if (progress) progress(1);
}

void checkSampling(const ReadOptions& options, const Sink& sink) {
    if (options.sample_count == 0) return;
    if (sink.cloud.triangles.empty())
        throw Error(ExitCode::kBadUsage, fmt::format("{}: has no faces to sample", sink.scans.front().name));
    if (options.sample_count >= kNoSensor - sink.cloud.positions.size())
        throw Error(ExitCode::kBadUsage, fmt::format("cannot take as many as {} samples", options.sample_count));
}

/// Files of some programs carry normals that are all zero.
void dropEmptyNormals(Cloud& cloud) {
    const bool empty =
        std::all_of(cloud.normals.begin(), cloud.normals.end(), [](const Vec3f& n) { return n.isZero(0); });
    if (empty) cloud.normals = {};
}

} // namespace

Cloud readInputs(const std::vector<std::string>& paths, const ReadOptions& options, const ReadProgress& progress) {
    if (paths.empty()) throw Error(ExitCode::kBadUsage, "no input file");
    Cloud cloud;
    Sink sink(cloud);
    readFiles(paths, options, progress, sink);
    checkSampling(options, sink);
    addMeshNormals(cloud);
    const bool sampled = options.sample_count > 0;
    if (!sampled) noteCoarseMeshes(cloud, sink.scans);
    dropUnused(cloud, sink.scans, sink.bereft, sampled);
    if (sampled) sampleMeshes(cloud, sink.scans, options.sample_count, options.seed);
    dropEmptyNormals(cloud);
    return cloud;
}

} // namespace pointrt
