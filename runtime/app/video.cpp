// SPDX-License-Identifier: Apache-2.0
#include "runtime/app/video.h"

#include <filesystem>
#include <system_error>
#include <vector>

#include "format/base/error.h"
#include "format/os/environment.h"
#include "format/os/find_program.h"
#include "format/os/interrupt.h"
#include "runtime/scene/turntable.h"
#include "runtime/session/tool_run.h"

namespace pointrt {
namespace {

namespace fs = std::filesystem;
using Words = std::vector<std::string>;

constexpr const char* kEncoder = "ffmpeg";

fs::path folderOf(const Options& options) { return fs::path(options.output).parent_path(); }

/// The path of the video while it is incomplete.
std::string partOf(const Options& options) {
    return (folderOf(options) / ("video" + fs::path(options.video).extension().string())).string();
}

/// Qualities at which x264 and VP9 videos can hardly be distinguished from the pictures.
Words codecOf(const std::string& video) {
    if (video.ends_with(".webm")) return {"-c:v", "libvpx-vp9", "-crf", "24", "-b:v", "0", "-row-mt", "1"};
    return {"-c:v", "libx264", "-crf", "18", "-movflags", "+faststart"};
}

/// Converts to 4:2:0, which every player supports but which needs even widths and heights, and tags the video with its
/// colour space and range.
Words encoderArguments(const Options& options, const std::string& encoder) {
    Words words{encoder, "-nostdin", "-hide_banner", "-loglevel",
                "error", "-y",       "-framerate",   std::to_string(options.fps)};
    const auto add = [&](const Words& more) { words.insert(words.end(), more.begin(), more.end()); };
    add({"-i", safeArgument(options.output)});
    add({"-vf", "pad=ceil(iw/2)*2:ceil(ih/2)*2,scale=out_color_matrix=bt709:out_range=tv,format=yuv420p"});
    add({"-colorspace", "bt709", "-color_primaries", "bt709", "-color_trc", "iec61966-2-1", "-color_range", "tv"});
    add(codecOf(options.video));
    add({safeArgument(partOf(options))});
    return words;
}

/// Deletes the pictures, and the folder if nothing else is in it.
void removePictures(const Options& options) {
    std::error_code ignored;
    for (std::uint32_t frame = 0; fs::remove(frameName(options.output, frame), ignored); ++frame) {
    }
    fs::remove(partOf(options), ignored);
    fs::remove(folderOf(options), ignored);
}

} // namespace

std::string findEncoder(const std::string& video) {
    const std::string search_path = environmentVariable("PATH");
    const std::string encoder = findProgram(kEncoder, search_path);
    if (!encoder.empty()) return encoder;
    throw Error{ExitCode::kCannotRun, video + ": ffmpeg, which encodes videos, is not in PATH (" + search_path +
                                          "); install it, or render pictures, as with -o frames/%04d.png"};
}

void prepareVideo(const Options& options) {
    removePictures(options);
    std::error_code error;
    fs::create_directory(folderOf(options), error);
    if (error) throw Error{ExitCode::kCannotWrite, options.video + ": " + error.message()};
}

void encodeVideo(const Options& options, const std::string& encoder) {
    const std::string pictures = "; the pictures are in " + folderOf(options).string();
    const ToolResult end = runTool(
        encoderArguments(options, encoder), kEncoder, [] { return interrupted(); },
        [](const std::string&) { return false; });
    if (interrupted()) return;
    if (end.wait_status != 0)
        throw Error{ExitCode::kCannotRun, options.video + ": " + describeFailure(end, kEncoder) + pictures};
    std::error_code error;
    fs::rename(partOf(options), options.video, error);
    if (error) throw Error{ExitCode::kCannotWrite, options.video + ": " + error.message() + pictures};
    removePictures(options);
}

} // namespace pointrt
