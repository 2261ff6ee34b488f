// SPDX-License-Identifier: Apache-2.0
// The command line of pointrt-view.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "runtime/frame_limits.h"
#include "runtime/render.h"

namespace pointrt {

/// What a scene file may say too; empty where the command line is silent.
struct SceneChoices {
    std::optional<Integrator> integrator;
    std::optional<std::uint32_t> bounces, spp, width, height;
    std::optional<double> fov_deg;
};

enum class DenoiseChoice { kAuto, kOn, kOff };

struct Options {
    std::string scene;
    std::string output;    ///< ends in .png or .exr; empty with bench_frames or list_devices
    std::string device;    ///< a selector, see DeviceRequest
    std::string stats;     ///< file for the report, "-" for standard output, empty for none
    RenderSettings render; ///< but for what choices has: resolveSettings (settings.h) puts them together
    SceneChoices choices;
    FrameLimits limits;
    DenoiseChoice denoise = DenoiseChoice::kAuto;
    std::optional<float> exposure;  ///< stops, for PNG
    bool resume = false;            ///< go on with the film in output, which ends in .exr
    std::uint32_t bench_frames = 0; ///< 0: no benchmark
    bool list_devices = false;
    bool quiet = false, verbose = false;
};

/// Fills options from the command line. Returns an exit code where the run ends here (--help and --version, whose text
/// goes to standard output). Throws Error kBadUsage with one line for anything wrong.
std::optional<int> parseOptions(int argc, const char* const* argv, Options& options);

} // namespace pointrt
