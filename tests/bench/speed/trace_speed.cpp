// SPDX-License-Identifier: Apache-2.0
// Rays per second of our tracer and of Embree's oriented discs with the same splats, rays and cores.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "format/base/run_tool.h"
#include "tests/bench/speed/file_rays.h"
#include "tests/bench/speed/speed.h"

namespace pointrt::test {

namespace {

using Json = nlohmann::ordered_json;

struct Options {
    std::string scene, device;
    Traversal traversal = Traversal::kWalk;
    std::string rays, hits;         ///< files; empty: none
    std::vector<std::string> kinds; ///< empty: all
    int runs = 7;
    std::uint32_t size = 1024;
    double fov_deg = CameraRequest{}.fov_deg;
    bool json = false, robust = false;
};

/// Settings shared by all kinds of rays.
struct Setting {
    std::string scene, device;
    std::size_t splats = 0;
    double device_bytes_per_splat = 0, embree_bytes_per_splat = 0;
};

bool wanted(const Options& options, RayKind kind) {
    const auto& kinds = options.kinds;
    return kinds.empty() || std::find(kinds.begin(), kinds.end(), nameOf(kind)) != kinds.end();
}

const char* nameOf(EmbreeMode mode) { return mode == EmbreeMode::kSingle ? "single" : "packets of 8"; }

Json toJson(const Setting& setting, const Speed& speed) {
    return {{"scene", setting.scene},
            {"splats", setting.splats},
            {"rays", nameOf(speed.kind)},
            {"ray_count", speed.rays},
            {"hit_share", speed.hit_share},
            {"mrays_per_second", speed.ours},
            {"embree_mrays_per_second", speed.embree},
            {"ratio", speed.ratio},
            {"ratio_min", speed.ratio_min},
            {"ratio_max", speed.ratio_max},
            {"ratio_blended", speed.ratio_blended},
            {"agreement", speed.agreement},
            {"embree_mode", nameOf(speed.embree_mode)},
            {"device", setting.device},
            {"device_bytes_per_splat", setting.device_bytes_per_splat},
            {"embree_bytes_per_splat", setting.embree_bytes_per_splat}};
}

void printTable(const Setting& setting, std::span<const Speed> speeds) {
    std::printf("%s: %zu splats; %.1f bytes a splat on the device, %.1f in Embree; %s\n", setting.scene.c_str(),
                setting.splats, setting.device_bytes_per_splat, setting.embree_bytes_per_splat, setting.device.c_str());
    std::printf("%-8s %9s %6s %8s %8s %7s %15s %8s %10s  %s\n", "rays", "count", "hit %", "Mrays/s", "Embree", "ratio",
                "min .. max", "blended", "agree %", "Embree by");
    for (const Speed& speed : speeds)
        std::printf("%-8s %9zu %6.2f %8.2f %8.2f %7.3f %6.3f .. %5.3f %8.3f %10.4f  %s\n", nameOf(speed.kind),
                    speed.rays, 100 * speed.hit_share, speed.ours, speed.embree, speed.ratio, speed.ratio_min,
                    speed.ratio_max, speed.ratio_blended, 100 * speed.agreement, nameOf(speed.embree_mode));
}

DeviceRequest requestOf(const Options& options) {
    DeviceRequest request;
    request.selector = options.device;
    request.traversal = options.traversal;
    return request;
}

/// Times the rays of a file with our walk alone.
int runFile(const Options& options) {
    RayCaster caster(options.scene, requestOf(options), options.size * options.size);
    const FileWalk walk =
        walkFile(caster, options.scene, options.rays, options.hits, options.size * options.size, options.runs);
    const double million_rays = 1e-6 * static_cast<double>(walk.rays);
    std::printf("%s\n", Json{{"rays", walk.rays},
                             {"hits", walk.hits},
                             {"mrays_per_second", million_rays / walk.seconds},
                             {"device", caster.deviceName()}}
                            .dump()
                            .c_str());
    return 0;
}

int run(const Options& options) {
    if (!options.rays.empty()) return runFile(options);
    const std::vector<CubeSplat> splats = loadCubeSplats(options.scene);
    const EmbreeDiscs discs(splats, options.robust ? EmbreeFlag::kRobust : EmbreeFlag::kFast);
    RayCaster caster(options.scene, requestOf(options), options.size * options.size);
    const double count = static_cast<double>(splats.size());
    const Setting setting{std::filesystem::path(options.scene).stem(), caster.deviceName(), splats.size(),
                          static_cast<double>(caster.sceneDeviceBytes()) / count,
                          static_cast<double>(discs.bytes()) / count};
    const std::vector<Ray> primary = caster.cameraRays(options.size, options.fov_deg);
    const std::vector<CastHit> hits = caster.cast(primary);
    const Vec3 light = caster.lightPosition();

    std::vector<Speed> speeds;
    for (const RayKind kind : kRayKinds) {
        if (!wanted(options, kind)) continue;
        const std::vector<Ray> rays = raysOf(kind, primary, hits, light);
        if (rays.empty()) throw Error(ExitCode::kBadInput, options.scene + ": no " + nameOf(kind) + " rays in view");
        speeds.push_back(measureSpeed(caster, discs, splats, rays, kind, options.runs));
    }
    Json report = Json::array();
    for (const Speed& speed : speeds) report.push_back(toJson(setting, speed));
    if (options.json)
        std::printf("%s\n", report.dump(2).c_str());
    else
        printTable(setting, speeds);
    return 0;
}

int parseAndRun(int argc, char** argv) {
    CLI::App app("Times our tracer and Embree on the same rays.", "trace_speed");
    Options options;
    app.add_option("SCENE.pro", options.scene)->required();
    app.add_option("--runs", options.runs, "Counted turns of each tracer")->check(CLI::Range(1, 1000));
    // 64 bytes per ray must fit in the 128 MiB that some drivers allow for a storage buffer
    app.add_option("--size", options.size, "Pixels a side, a multiple of 16")
        ->check(CLI::Range(16, 1424))
        ->check([](const std::string& text) { return std::stoul(text) % 16 ? "not a multiple of 16" : ""; });
    app.add_option("--kinds", options.kinds, "Rays to time: primary,shadow,mirror,diffuse (default all)")
        ->delimiter(',')
        ->check(CLI::IsMember({"primary", "shadow", "mirror", "diffuse"}));
    app.add_option("--fov", options.fov_deg, "Vertical field of view in degrees; a smaller one looks closer")
        ->check(CLI::Range(1.0, 40.0)); // at larger angles the scene only gets smaller
    const auto rays =
        app.add_option("--rays", options.rays, "An array of rays (.npy) for our walk alone, in place of the view's");
    app.add_option("--hits", options.hits, "What they hit, an array (.npy) of t_hit and splat_ids")->needs(rays);
    app.add_option("--device", options.device, "Vulkan device, by index or name");
    app.add_option_function<std::string>(
           "--traversal", [&](const std::string& text) { options.traversal = parseName(kTraversalNames, text); },
           "How our rays find cells: walk, or hardware, by the device's ray queries")
        ->check(CLI::IsMember(wordsOf(kTraversalNames)));
    app.add_flag("--robust", options.robust, "Embree with its robust flag, which is slower");
    app.add_flag("--json", options.json, "JSON on standard output instead of a table");
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        return error.get_exit_code() == 0 ? app.exit(error) : (app.exit(error), static_cast<int>(ExitCode::kBadUsage));
    }
    return runTool("trace_speed", [&] { return run(options); });
}

} // namespace

} // namespace pointrt::test

int main(int argc, char** argv) { return pointrt::test::parseAndRun(argc, argv); }
