// SPDX-License-Identifier: Apache-2.0
// device_bench list DEVICE TUNING | make CASE DATA FOLDER | cameras CASE | judge CASE DATA SCAN PICTURE...: the
// subcommands that devices.sh runs.
#include <fmt/format.h>

#include <cstdio>
#include <span>

#include "format/base/run_tool.h"
#include "tests/bench/quality/devices/judge.h"

namespace pointrt::quality {

namespace {

using Words = std::span<const std::string>;

constexpr const char* kUsage =
    "device_bench list DEVICE TUNING | make CASE DATA FOLDER | cameras CASE | judge CASE DATA SCAN PICTURE...";

DeviceCase caseOf(const std::string& name) {
    for (DeviceCase& row : deviceCases())
        if (row.name() == name) return std::move(row);
    throw Error(ExitCode::kBadUsage, name + ": not a case");
}

/// device: only that device; "": all. tuning: "": also cases held out.
int list(const std::string& device, const std::string& tuning) {
    for (const DeviceCase& row : deviceCases())
        if ((device.empty() || row.device == device) && (tuning.empty() || !row.held_out))
            std::puts(row.name().c_str());
    return 0;
}

int make(const DeviceCase& row, const std::string& data, const std::string& folder) {
    const World world = row.world(data);
    std::puts(row.scan(WorldTracing(world), folder).c_str());
    return 0;
}

/// One line per camera: eye, target, up, field of view, pixels per side.
int printCameras(const DeviceCase& row) {
    const auto text = [](const Vec3d& v) { return fmt::format("{},{},{}", v.x(), v.y(), v.z()); };
    for (const Pinhole& camera : row.cameras)
        std::puts(fmt::format("{} {} {} {} {}", text(camera.eye), text(camera.target), text(camera.up), camera.fov_deg,
                              camera.size)
                      .c_str());
    return 0;
}

int judge(const DeviceCase& row, const std::string& data, const std::string& scan, Words pictures) {
    if (pictures.size() != row.cameras.size()) throw Error(ExitCode::kBadUsage, "takes a picture a camera");
    const World world = row.world(data);
    const WorldTracing tracing(world);
    const RawPoints raw = loadRawPoints({scan}, world.mesh.frame);
    nlohmann::ordered_json report{{"device", row.device}, {"subject", row.subject}, {"held_out", row.held_out}};
    for (std::size_t i = 0; i < pictures.size(); ++i)
        report["views"].push_back(judgePicture(row, tracing, raw, row.cameras[i], pictures[i]));
    std::puts(report.dump(2).c_str());
    return 0;
}

int run(Words words) {
    if (words.size() == 3 && words[0] == "list") return list(words[1], words[2]);
    if (words.size() == 2 && words[0] == "cameras") return printCameras(caseOf(words[1]));
    if (words.size() == 4 && words[0] == "make") return make(caseOf(words[1]), words[2], words[3]);
    if (words.size() > 4 && words[0] == "judge") return judge(caseOf(words[1]), words[2], words[3], words.subspan(4));
    throw Error(ExitCode::kBadUsage, kUsage);
}

} // namespace

} // namespace pointrt::quality

int main(int argc, char** argv) {
    return pointrt::runTool("device_bench", [&] {
        const std::vector<std::string> words(argv + 1, argv + argc);
        return pointrt::quality::run(words);
    });
}
