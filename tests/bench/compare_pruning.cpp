// SPDX-License-Identifier: Apache-2.0
// Compares first hits of a scan baked with --prune off and with --prune on, for random and grazing rays from outside.
#include <algorithm>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "pointrt/pro.hpp"
#include "tests/bench/compare_options.h"
#include "tests/support/pruning_change.h"

namespace pointrt::test {

namespace {

using Json = nlohmann::ordered_json;

void requireSameSplats(const std::string& full, const std::string& pruned) {
    const ProFile a(full), b(pruned);
    if (a.info().scale != b.info().scale || !std::ranges::equal(a.splats(), b.splats()))
        throw Error(ExitCode::kBadInput, pruned + ": other splats than in " + full + ": bake the same scan twice");
    if (a.info().flags & PRO_FLAG_PRUNED) throw Error(ExitCode::kBadInput, full + ": is pruned itself");
}

Json describe(const std::string& path) {
    const ProFile file(path);
    const pro_info& info = file.info();
    return {{"path", path}, {"splats", info.splat_count}, {"leaves", info.leaf_count}, {"references", info.ref_count}};
}

Json toJson(const SurfaceChange& change, std::size_t hits) {
    const auto share = [&](std::size_t count) {
        return hits ? static_cast<double>(count) / static_cast<double>(hits) : 0;
    };
    return {{"moved_along_ray", change.moved_along_ray},
            {"moved_along_ray_share", share(change.moved_along_ray)},
            {"moved_along_normal", change.moved_along_normal},
            {"moved_along_normal_share", share(change.moved_along_normal)},
            {"move_along_normal_p999_radii", change.move_p999},
            {"move_along_normal_max_radii", change.move_max},
            {"normal_mean_deg", change.angle_mean},
            {"normal_p99_deg", change.angle_p99},
            {"normal_p999_deg", change.angle_p999},
            {"normal_max_deg", change.angle_max}};
}

Json toJson(const PruningChange& change) {
    const auto rays = static_cast<double>(change.rays);
    return {{"rays", change.rays},
            {"hits_full", change.hits_full},
            {"hits_pruned", change.hits_pruned},
            {"hits_both", change.hits_both},
            {"hit_to_miss", change.lost},
            {"hit_to_miss_share", static_cast<double>(change.lost) / rays},
            {"miss_to_hit", change.gained},
            {"miss_to_hit_share", static_cast<double>(change.gained) / rays},
            {"flat", toJson(change.flat, change.hits_both)},
            {"blended", toJson(change.blended, change.hits_both)}};
}

void print(const char* surface, const SurfaceChange& change, std::size_t hits) {
    const double percent = 100.0 / static_cast<double>(std::max<std::size_t>(hits, 1));
    std::printf("  %-8s moved along ray %.4f%%, along normal %.4f%% (p99.9 %.4f, max %.3f radii); normal mean %.4f p99 "
                "%.3f p99.9 %.3f max %.2f deg\n",
                surface, percent * static_cast<double>(change.moved_along_ray),
                percent * static_cast<double>(change.moved_along_normal), change.move_p999, change.move_max,
                change.angle_mean, change.angle_p99, change.angle_p999, change.angle_max);
}

void print(const char* kind, const PruningChange& change) {
    std::printf("%s: %zu rays, %zu hits, %zu pruned; hit to miss %zu, miss to hit %zu\n", kind, change.rays,
                change.hits_full, change.hits_pruned, change.lost, change.gained);
    print("flat", change.flat, change.hits_both);
    print("blended", change.blended, change.hits_both);
}

int compare(const std::string& full_path, const std::string& pruned_path, const CompareOptions& options) {
    requireSameSplats(full_path, pruned_path);
    const std::vector<CubeSplat> splats = loadCubeSplats(full_path);
    RayCaster full(full_path), pruned(pruned_path);
    const auto change = [&](const std::vector<Ray>& rays) {
        return measurePruning(splats, rays, full.cast(rays), pruned.cast(rays));
    };
    const PruningChange random = change(randomRays(boundingSphere(splats), options.rays, options.seed));
    const PruningChange grazing = change(grazingRays(splats, options.rays, options.seed));
    if (options.json) {
        const Json report = {{"full", describe(full_path)},
                             {"pruned", describe(pruned_path)},
                             {"seed", options.seed},
                             {"moved_means_more_than_radii", kMovedRadii},
                             {"trace_seconds_full", full.traceSeconds()},
                             {"trace_seconds_pruned", pruned.traceSeconds()},
                             {"random", toJson(random)},
                             {"grazing", toJson(grazing)}};
        std::printf("%s\n", report.dump(2).c_str());
        return 0;
    }
    print("random", random);
    print("grazing", grazing);
    return 0;
}

} // namespace

} // namespace pointrt::test

int main(int argc, char** argv) {
    CLI::App app("Compares first hits of a scan baked without and with pruning.", "compare_pruning");
    std::string full, pruned;
    pointrt::test::CompareOptions options;
    app.add_option("FULL.pro", full, "Baked with --prune off")->required();
    app.add_option("PRUNED.pro", pruned, "The same scan, baked with --prune on")->required();
    pointrt::test::addCompareOptions(app, options);
    return pointrt::test::runCompare(app, argc, argv, [&] { return pointrt::test::compare(full, pruned, options); });
}
