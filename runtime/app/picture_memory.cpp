// SPDX-License-Identifier: Apache-2.0
#include "runtime/app/picture_memory.h"

#include <filesystem>
#include <string>

#include "format/base/error.h"
#include "format/os/memory.h"
#include "runtime/render/film_readout.h"
#include "runtime/render/frame_limits.h"
#include "runtime/render/picture_filter.h"
#include "runtime/session/settings.h"
#include "runtime/util/memory_text.h"

namespace pointrt {
namespace {

bool mayBeFiltered(const RenderSession& session, const Options& options) {
    const bool may_end_early = options.limits.seconds || options.limits.noise;
    return wantsDenoising(session, options, may_end_early ? 1 : session.settings.spp);
}

std::uint64_t bytesOfFilter(const RenderSession& session, const Options& options) {
    const PixelSize size{session.settings.width, session.settings.height};
    const bool wraps = session.camera.panorama;
    if (!mayBeFiltered(session, options)) return 0;
    return filterBytes({.picture = size, .tile = filterTileFor(size, wraps), .wraps = wraps});
}

std::uint64_t bytesInRows(const RenderSession& session, const Options& options) {
    const RenderSettings& settings = session.settings;
    const std::uint64_t width = settings.width, pixels = width * settings.height;
    const std::uint64_t band = width * tilingFor(session.device, settings.width, settings.height).band_rows;
    const std::uint64_t noise = reportsNoise(options) && settings.spp > 1 ? kNoiseBytes * pixels : 0;
    return band * filmBytesPerPixel(settings) + noise;
}

/// A resumed film is in memory twice while it is read: as decoded from the file, and as a film.
std::uint64_t bytesOfFilm(const RenderSession& session, const Options& options) {
    const std::uint64_t pixels = std::uint64_t{session.settings.width} * session.settings.height;
    const bool is_resumed = options.resume && std::filesystem::exists(options.output);
    return (is_resumed ? 2 : 1) * pixels * filmBytesPerPixel(session.settings);
}

std::string named(const Options& options) { return options.output.empty() ? "" : options.output + ": "; }

} // namespace

bool writesAsItRenders(const Options& options) {
    return writesToneMapped(options) && !options.limits.seconds && !options.limits.noise && options.turntable == 0 &&
           options.bench_frames == 0;
}

bool reportsNoise(const Options& options) {
    return options.verbose || !options.stats.empty() || options.bench_frames != 0;
}

std::uint64_t pictureBytes(const RenderSession& session, const Options& options) {
    return bytesOfFilter(session, options) +
           (writesAsItRenders(options) ? bytesInRows(session, options) : bytesOfFilm(session, options));
}

void requirePictureMemory(const RenderSession& session, const Options& options) {
    const std::uint64_t bytes = pictureBytes(session, options), available = availableMemory();
    if (bytes <= available) return;
    const RenderSettings& settings = session.settings;
    const SizeAndLimit shown = sizeAndLimit(bytes, available, gibibytes);
    throw Error{ExitCode::kCannotRun, named(options) + "a picture of " + std::to_string(settings.width) + "x" +
                                          std::to_string(settings.height) + " pixels needs " + shown.size +
                                          " of memory, but only " + shown.limit + " are free"};
}

} // namespace pointrt
