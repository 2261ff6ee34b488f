// SPDX-License-Identifier: Apache-2.0
// What a user did to a window, as a text file: written while it happens, edited by hand, replayed by tests.
//
//     pointrt-recording 1 window 1280x720 scale 1
//     # frame, what, how
//     0 wait 4                  until the picture has 4 samples a pixel
//     1 cursor 640 360
//     1 button down left        or up; left, right, middle
//     2 cursor 700 365.5
//     3 button up left
//     4 wheel 0 -1
//     5 key down F12            or up; A, 7, Space, Escape, Shift, PageUp ... and any sign, # as Hash, " as Quote
//     5 text "a"                what was typed, maybe more than one character
//     6 resize 640x480 scale 2
//     7 drop "/scans/a b.pro" "c.ply"
//     8 screenshot turned       letters, digits, . _ -; not beginning with a dot
//     9 quit                    or close: what the window's own button sends
//
// Frames never go back. Strings have the escapes \\ \" \n \r \t and \xHH, a byte.
#pragma once

#include <cstdint>
#include <cstdio>
#include <memory>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "runtime/util/pixel_size.h"
#include "runtime/window/input/events.h"

namespace pointrt {

/// Take a picture and call it this.
struct ScreenshotStep {
    std::string name;
};
/// Go on when the picture has as many samples a pixel.
struct WaitStep {
    std::uint32_t samples = 1;
};
struct QuitStep {};

using RecordedStep = std::variant<InputEvent, ScreenshotStep, WaitStep, QuitStep>;

struct RecordedEvent {
    std::uint32_t frame = 0; ///< in which it happens, before that is drawn; 0: the first
    RecordedStep step;
};

struct Recording {
    ResizeEvent window; ///< at the start; not minimised
    std::vector<RecordedEvent> events;
};

// What a reader takes; writers keep within it.
constexpr std::uint32_t kMaxRecordedFrame = 10'000'000; // four days of 30 a second
constexpr std::size_t kMaxRecordedEvents = 1'000'000;
constexpr std::size_t kMaxRecordingBytes = std::size_t(64) << 20;
constexpr std::uint32_t kMaxWindowSide = kMaxPixelSide;
constexpr double kMinWindowScale = 0.1, kMaxWindowScale = 16;
constexpr double kMaxCursor = 1e6; // window units
constexpr double kMaxWheel = 1000;
constexpr std::uint32_t kMaxWait = 65536; // as many samples as a picture may have
constexpr std::size_t kMaxDropped = 1024, kMaxPathBytes = 4096, kMaxNameBytes = 100;

/// Throws Error kBadInput "PATH:LINE: reason", without the line where the file cannot be read.
Recording readRecording(const std::string& path);
/// The same of text; path is for messages.
Recording parseRecording(std::string_view text, const std::string& path);

/// The first line and that of an event, with \n. What no window sends is brought into the limits above, or "" where
/// that leaves nothing of it.
std::string recordingHeader(const ResizeEvent& window);
std::string recordingLine(const RecordedEvent& event);

struct CloseFile {
    void operator()(std::FILE* file) const { std::fclose(file); }
};

/// Every line is on its way to the disk when record returns: after a crash the file has all of them.
struct RecordingWriter {
    std::string path;
    std::unique_ptr<std::FILE, CloseFile> file;
    std::uint32_t last_frame = 0;
};

/// Replaces what is at path. Throws Error kCannotWrite "PATH: reason", as record does.
RecordingWriter openRecording(const std::string& path, const ResizeEvent& window);
/// A frame before the last one counts as the last one.
void record(RecordingWriter& writer, RecordedEvent event);

} // namespace pointrt
