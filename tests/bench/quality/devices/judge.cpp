// SPDX-License-Identifier: Apache-2.0
#include "tests/bench/quality/devices/judge.h"

#include <tbb/parallel_for.h>

#include "runtime/image/image_png.h"
#include "tests/bench/quality/angles.h"
#include "tests/bench/quality/raw/raw_report.h"

namespace pointrt::quality {

namespace {

/// Distances at which a ray from outside enters and leaves a crown.
std::optional<std::pair<double, double>> throughCrown(const Crown& crown, const Vec3d& origin, const Vec3d& direction) {
    const Vec3d from = (origin - crown.center).cwiseQuotient(crown.radii), along = direction.cwiseQuotient(crown.radii);
    const double a = along.squaredNorm(), b = from.dot(along), c = from.squaredNorm() - 1, root = b * b - a * c;
    if (root <= 0 || c <= 0 || b >= 0) return std::nullopt;
    return std::pair{(-b - std::sqrt(root)) / a, (-b + std::sqrt(root)) / a};
}

} // namespace

GapCounts countGaps(const World& world, const Sights& truth, const Sights& picture, const UnitCamera& camera) {
    GapCounts counts;
    for (std::size_t i = 0; i < truth.size(); ++i)
        for (const Crown& crown : world.crowns) {
            const auto span = throughCrown(crown, camera.eye().cast<double>(), camera.direction(i).cast<double>());
            if (!span || truth[i].t < span->first) continue;
            ++counts.sights;
            counts.truth += truth[i].t > span->second;
            counts.picture += picture[i].t > span->second;
        }
    return counts;
}

std::vector<float> wallDegrees(const WorldTracing& world, const RawPoints& raw, double seen_reach, const Sights& truth,
                               const Sights& picture, const UnitCamera& camera) {
    std::vector<float> degrees(truth.size(), -1);
    tbb::parallel_for(std::size_t{0}, truth.size(), [&](std::size_t i) {
        if (!truth[i].hit() || !picture[i].hit()) return;
        const auto hit = world.tracing().firstHit(camera.eye(), camera.direction(i));
        if (!hit || world.world().parts[hit->primitive] != Part::kWall) return;
        if (!raw.isSampled(camera.place(i, truth[i].t), static_cast<float>(seen_reach))) return;
        degrees[i] =
            static_cast<float>(degreesBetweenLines(truth[i].normal.cast<double>(), picture[i].normal.cast<double>()));
    });
    std::erase_if(degrees, [](float value) { return value < 0; });
    return degrees;
}

void writeLit(const std::string& path, const Sights& sights, const UnitCamera& camera) {
    const auto size = static_cast<std::size_t>(camera.size());
    const Vec3f right = camera.direction(size - 1) - camera.direction(0);
    const Vec3f down = camera.direction(size * (size - 1)) - camera.direction(0);
    Image8 image{static_cast<std::uint32_t>(size), static_cast<std::uint32_t>(size), 3, {}};
    for (std::size_t i = 0; i < sights.size(); ++i) {
        const Vec3f to_lamp = (0.5f * right.normalized() - 0.7f * down.normalized() - camera.direction(i)).normalized();
        const float light = 0.1f + 0.9f * std::max(0.0f, sights[i].normal.dot(to_lamp));
        const float shown = sights[i].hit() ? std::pow(light, 1 / 2.2f) : 0;
        image.pixels.insert(image.pixels.end(), 3, static_cast<std::uint8_t>(255 * shown + 0.5f));
    }
    writePng(path, image);
}

nlohmann::ordered_json judgePicture(const DeviceCase& row, const WorldTracing& world, const RawPoints& raw,
                                    const Pinhole& pinhole, const std::string& picture_path) {
    const Mesh& mesh = world.world().mesh;
    const UnitCamera camera(pinhole, mesh.frame);
    const Sights truth = castMesh(mesh, world.tracing(), camera),
                 picture = readSights(picture_path, pinhole, mesh.frame);
    const AllAndSeen errors = compareSights(
        truth, picture, camera,
        {world.tracing(), raw, static_cast<float>(row.depth_tolerance), static_cast<float>(row.seen_reach)});
    nlohmann::ordered_json figures{{"all", figuresOf(errors.all)}, {"seen", figuresOf(errors.seen)}};
    const auto walls = wallDegrees(world, raw, row.seen_reach, truth, picture, camera);
    if (!walls.empty()) figures["wall_normal_mean"] = summarize(walls).mean;
    const GapCounts gaps = countGaps(world.world(), truth, picture, camera);
    if (gaps.sights > 0) {
        figures["gap_truth"] = static_cast<double>(gaps.truth) / static_cast<double>(gaps.sights);
        figures["gap"] = static_cast<double>(gaps.picture) / static_cast<double>(gaps.sights);
    }
    writeLit(picture_path + ".truth.png", truth, camera);
    writeLit(picture_path + ".lit.png", picture, camera);
    writeErrors(picture_path + ".errors.png", errors.pixels);
    return figures;
}

} // namespace pointrt::quality
