// SPDX-License-Identifier: Apache-2.0
#include "tests/bench/speed/file_rays.h"

#include <algorithm>
#include <cstring>
#include <fstream>
#include <limits>

#include "format/base/error.h"
#include "pointrt/pro.hpp"
#include "runtime/rays/npy_header.h"
#include "runtime/rays/ray_source.h"

namespace pointrt::test {
namespace {

Vec3 roundToFloat(Vec3 v) { return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)}; }

/// A row of the file in cube units, with the length that its direction had there.
struct FileRay {
    Ray ray;
    double length = 0; ///< of its direction, cube units
};

FileRay rayOf(const double* six, const pro_info& info) {
    const Vec3 origin{six[0] - info.origin[0], six[1] - info.origin[1], six[2] - info.origin[2]};
    const Vec3 direction{six[3], six[4], six[5]};
    return {{roundToFloat(1 / info.scale * origin), roundToFloat(normalize(direction)), {}, 0},
            length(direction) / info.scale};
}

std::vector<FileRay> raysOf(const RayBlock& block, const pro_info& info) {
    const std::vector<double> widened(block.floats.begin(), block.floats.end());
    const std::vector<double>& numbers = block.floats.empty() ? block.doubles : widened;
    std::vector<FileRay> rays;
    for (std::size_t i = 0; i + 6 <= numbers.size(); i += 6) rays.push_back(rayOf(numbers.data() + i, info));
    return rays;
}

double medianSeconds(RayCaster& caster, int runs) {
    caster.traceLoaded(); // warms up
    std::vector<double> seconds;
    for (int i = 0; i < runs; ++i) seconds.push_back(caster.traceLoaded());
    std::nth_element(seconds.begin(), seconds.begin() + runs / 2, seconds.end());
    return seconds[static_cast<std::size_t>(runs) / 2];
}

/// The number of rays must be known before the first is written.
class HitFile {
public:
    HitFile(const std::string& path, std::uint64_t rays) : path_(path), out_(path, std::ios::binary) {
        out_ << npyHeader("[('t_hit', '<f8'), ('splat_ids', '<u4')]", "(" + std::to_string(rays) + ",)");
    }

    void add(const CastHit& hit, const FileRay& from) {
        const double t = hit.hit() ? hit.t_flat / from.length : std::numeric_limits<double>::infinity();
        char record[sizeof t + sizeof hit.splat];
        std::memcpy(record, &t, sizeof t);
        std::memcpy(record + sizeof t, &hit.splat, sizeof hit.splat);
        out_.write(record, sizeof record);
    }

    void finish() {
        if (!out_.flush()) throw Error(ExitCode::kCannotWrite, path_ + ": cannot be written");
    }

private:
    std::string path_;
    std::ofstream out_;
};

/// Adds the results of one batch.
void walkBatch(RayCaster& caster, std::span<const FileRay> batch, int runs, std::optional<HitFile>& file,
               FileWalk& walk) {
    std::vector<Ray> rays;
    for (const FileRay& each : batch) rays.push_back(each.ray);
    caster.load(rays);
    walk.seconds += medianSeconds(caster, runs);
    const std::vector<CastHit> hits = caster.loadedHits();
    for (std::size_t i = 0; i < batch.size(); ++i) {
        walk.hits += hits[i].hit();
        if (file) file->add(hits[i], batch[i]);
    }
    walk.rays += batch.size();
}

} // namespace

FileWalk walkFile(RayCaster& caster, const std::string& scene, const std::string& path, const std::string& hits_path,
                  std::size_t batch_rays, int runs) {
    const pro_info info = ProFile(scene, PRO_OPEN_TRACE).info();
    const std::unique_ptr<RaySource> source = openRays(path);
    if (!source->count()) throw Error(ExitCode::kBadInput, path + ": must be an array of rays");
    std::optional<HitFile> file;
    if (!hits_path.empty()) file.emplace(hits_path, *source->count());
    FileWalk walk;
    for (RayBlock block; source->next(block);) {
        const std::vector<FileRay> rays = raysOf(block, info);
        for (std::size_t first = 0; first < rays.size(); first += batch_rays) {
            const std::size_t count = std::min(batch_rays, rays.size() - first);
            walkBatch(caster, std::span(rays).subspan(first, count), runs, file, walk);
        }
    }
    if (file) file->finish();
    return walk;
}

} // namespace pointrt::test
