// SPDX-License-Identifier: Apache-2.0
// Rays per second of the library's calls, compared with the walk alone (trace_speed) on the same rays.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <ctime>
#include <functional>

#include "format/base/run_tool.h"
#include "pointrt/pro.hpp"
#include "pointrt/trace.hpp"
#include "tests/bench/speed/ray_kinds.h"

namespace pointrt::test {
namespace {

struct Options {
    std::string scene, device;
    int runs = 7;
    std::uint32_t size = 1024;
};

/// Results of one call.
struct Cost {
    double seconds = 0;
    double processor = 0; ///< CPU seconds of all cores: more reliable than wall time on a busy machine
};

template <typename Value>
double median(std::vector<Cost>& costs, Value Cost::*value) {
    const auto middle = costs.begin() + static_cast<std::ptrdiff_t>(costs.size() / 2);
    std::nth_element(costs.begin(), middle, costs.end(),
                     [&](const Cost& a, const Cost& b) { return a.*value < b.*value; });
    return (*middle).*value;
}

/// The median over runs of work, which returns its seconds, after one run as a warm-up.
Cost medianCost(int runs, const std::function<double()>& work) {
    work(); // warms up
    std::vector<Cost> costs;
    for (int i = 0; i < runs; ++i) {
        const std::clock_t start = std::clock();
        const double seconds = work();
        costs.push_back({seconds, static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC});
    }
    return {median(costs, &Cost::seconds), median(costs, &Cost::processor)};
}

double timed(const std::function<void()>& work) {
    const auto start = std::chrono::steady_clock::now();
    work();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// Rays as callers have them: doubles in the scan's coordinates.
std::vector<double> rowsOf(std::span<const Ray> rays, const pro_info& info) {
    std::vector<double> rows;
    for (const Ray& ray : rays)
        rows.insert(rows.end(),
                    {info.origin[0] + info.scale * ray.origin.x, info.origin[1] + info.scale * ray.origin.y,
                     info.origin[2] + info.scale * ray.origin.z, ray.direction.x, ray.direction.y, ray.direction.z});
    return rows;
}

void measure(RayCaster& caster, const TraceScene& scene, const char* kind, std::span<const Ray> rays,
             const std::vector<double>& rows, int runs) {
    const std::size_t count = rays.size();
    const std::span<const double> given(rows);
    std::vector<double> t(count), positions(3 * count);
    std::vector<std::uint32_t> splats(count), instances(count);
    std::vector<float> normals(3 * count);
    std::vector<std::uint8_t> occluded(count);
    caster.load(rays);
    const Cost walk = medianCost(runs, [&] { return caster.traceLoaded(); });
    const std::vector<CastHit> expected = caster.loadedHits();
    const auto call = [&](const HitArrays& arrays) {
        return medianCost(runs, [&] { return timed([&] { scene.castRays(given, {}, arrays); }); });
    };
    const Cost all = call({t, splats, instances, normals, positions});
    const Cost ids = call({.t_hit = t, .splat_ids = splats, .instance_ids = instances});
    const Cost any = medianCost(runs, [&] { return timed([&] { scene.testOcclusions(given, {}, occluded); }); });
    const Cost walk_any = medianCost(runs, [&] { return caster.traceLoaded(true); });
    std::size_t same = 0;
    for (std::size_t i = 0; i < count; ++i) same += splats[i] == expected[i].splat;
    const double million = 1e-6 * static_cast<double>(count);
    std::printf("%-8s %9zu %8.2f %8.2f %6.3f %6.3f %8.2f %6.3f %8.2f %8.2f %6.3f %6.3f %9.4f\n", kind, count,
                million / walk.seconds, million / ids.seconds, walk.seconds / ids.seconds,
                walk.processor / ids.processor, million / all.seconds, walk.processor / all.processor,
                million / walk_any.seconds, million / any.seconds, walk_any.seconds / any.seconds,
                walk_any.processor / any.processor, 100 * static_cast<double>(same) / static_cast<double>(count));
}

int run(const Options& options) {
    RayCaster caster(options.scene, {options.device}, options.size * options.size);
    const TraceDevice device(options.device);
    const TraceScene scene(device, {options.scene});
    const pro_info info = ProFile(options.scene, PRO_OPEN_TRACE).info();
    const std::vector<Ray> primary = caster.cameraRays(options.size);
    const std::vector<CastHit> hits = caster.cast(primary);
    std::printf("%s: %llu splats; %s\n%-8s %9s %8s %8s %6s %6s %8s %6s %8s %8s %6s %6s %9s\n", options.scene.c_str(),
                static_cast<unsigned long long>(scene.splatCount()), device.name().c_str(), "rays", "count", "walk",
                "t, ids", "share", "cpu", "all", "cpu", "walk any", "any", "share", "cpu", "same %");
    for (const RayKind kind : kRayKinds) {
        const std::vector<Ray> rays = raysOf(kind, primary, hits, caster.lightPosition());
        if (!rays.empty()) measure(caster, scene, nameOf(kind), rays, rowsOf(rays, info), options.runs);
    }
    return 0;
}

int parseAndRun(int argc, char** argv) {
    CLI::App app("Times the library's casts, in Mrays/s, beside the walk alone.", "cast_speed");
    Options options;
    app.add_option("SCENE.pro", options.scene)->required();
    app.add_option("--runs", options.runs, "Counted turns of each")->check(CLI::Range(1, 1000));
    app.add_option("--size", options.size, "Pixels a side, a multiple of 16, as in trace_speed")
        ->check(CLI::Range(16, 1424));
    app.add_option("--device", options.device, "Vulkan device, by index or name");
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        return error.get_exit_code() == 0 ? app.exit(error) : (app.exit(error), static_cast<int>(ExitCode::kBadUsage));
    }
    return runTool("cast_speed", [&] { return run(options); });
}

} // namespace
} // namespace pointrt::test

int main(int argc, char** argv) { return pointrt::test::parseAndRun(argc, argv); }
