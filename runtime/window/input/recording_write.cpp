// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstring>

#include "format/base/error.h"
#include "runtime/window/input/recording.h"
#include "runtime/window/input/recording_words.h"

namespace pointrt {
namespace {

/// value clamped to the limits, round-tripping; NaN becomes 0.
std::string plain(double value, double low, double high) {
    char text[32];
    const double within = std::clamp(std::isnan(value) ? 0 : value, low, high);
    return {text, std::to_chars(text, text + sizeof text, within).ptr};
}

const char* downOrUp(bool down) { return down ? " down " : " up "; }

/// "WxH scale S". A side of 0 means minimised and becomes 0x0; least = 1 excludes that.
std::string sizeText(const ResizeEvent& size, std::uint32_t least) {
    std::uint32_t width = std::clamp(size.width, least, kMaxWindowSide);
    std::uint32_t height = std::clamp(size.height, least, kMaxWindowSide);
    if (width == 0 || height == 0) width = height = 0;
    return std::to_string(width) + "x" + std::to_string(height) + " scale " +
           plain(size.scale, kMinWindowScale, kMaxWindowScale);
}

struct EventText {
    std::string operator()(const KeyEvent& event) const { return "key" + (downOrUp(event.down) + keyName(event.key)); }
    std::string operator()(const TextEvent& event) const { return "text " + quotedText(utf8Of(event.code_point)); }
    std::string operator()(const ButtonEvent& event) const {
        return std::string("button") + downOrUp(event.down) + buttonName(event.button);
    }
    std::string operator()(const CursorEvent& event) const {
        return "cursor " + plain(event.x, -kMaxCursor, kMaxCursor) + " " + plain(event.y, -kMaxCursor, kMaxCursor);
    }
    std::string operator()(const WheelEvent& event) const {
        return "wheel " + plain(event.x, -kMaxWheel, kMaxWheel) + " " + plain(event.y, -kMaxWheel, kMaxWheel);
    }
    std::string operator()(const ResizeEvent& event) const { return "resize " + sizeText(event, 0); }
    /// "" if no dropped path can be recorded.
    std::string operator()(const DropEvent& event) const {
        std::string text;
        std::size_t count = 0;
        for (const std::string& path : event.paths)
            if (path.size() <= kMaxPathBytes && count++ < kMaxDropped) text += " " + quotedText(path);
        return text.empty() ? "" : "drop" + text;
    }
    std::string operator()(const CloseEvent&) const { return "close"; }

    std::string operator()(const InputEvent& event) const { return std::visit(EventText{}, event); }
    std::string operator()(const ScreenshotStep& step) const { return "screenshot " + step.name; }
    std::string operator()(const WaitStep& step) const {
        return "wait " + std::to_string(std::clamp<std::uint32_t>(step.samples, 1, kMaxWait));
    }
    std::string operator()(const QuitStep&) const { return "quit"; }
};

void append(RecordingWriter& writer, const std::string& text) {
    const bool written = std::fwrite(text.data(), 1, text.size(), writer.file.get()) == text.size();
    if (!written || std::fflush(writer.file.get()) != 0)
        throw Error{ExitCode::kCannotWrite, writer.path + ": " + std::strerror(errno)};
}

} // namespace

std::string recordingHeader(const ResizeEvent& window) {
    return "pointrt-recording 1 window " + sizeText(window, 1) + "\n";
}

std::string recordingLine(const RecordedEvent& event) {
    const std::string text = std::visit(EventText{}, event.step);
    return text.empty() ? "" : std::to_string(std::min(event.frame, kMaxRecordedFrame)) + " " + text + "\n";
}

RecordingWriter openRecording(const std::string& path, const ResizeEvent& window) {
    RecordingWriter writer;
    writer.path = path;
    writer.file.reset(std::fopen(path.c_str(), "wb"));
    if (!writer.file) throw Error{ExitCode::kCannotWrite, path + ": " + std::strerror(errno)};
    append(writer, recordingHeader(window));
    return writer;
}

void record(RecordingWriter& writer, RecordedEvent event) {
    event.frame = writer.last_frame = std::max(event.frame, writer.last_frame);
    append(writer, recordingLine(event));
}

} // namespace pointrt
