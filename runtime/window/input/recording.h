// SPDX-License-Identifier: Apache-2.0
// Recordings of user input as text files: written live, edited by hand, replayed by tests.
//
//     pointrt-recording 1 window 1280x720 scale 1
//     # frame, what, how
//     0 wait 4                  until the picture has 4 samples per pixel
//     1 cursor 640 360
//     1 button down left        or up; left, right, middle
//     2 cursor 700 365.5
//     3 button up left
//     4 wheel 0 -1
//     5 key down F12            or up; A, 7, Space, Escape, Shift, PageUp ... any character; # is Hash, " is Quote
//     5 text "a"                typed text of one or more characters
//     6 resize 640x480 scale 2
//     7 drop "/scans/a b.pro" "c.ply"
//     8 screenshot turned       letters, digits, . _ -; not starting with a dot
//     9 quit                    or close: the window's close button
//
// Frame numbers must not decrease. Strings have the escapes \\ \" \n \r \t and \xHH (a byte).
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

/// Saves the window's picture under this name.
struct ScreenshotStep {
    std::string name;
};
/// Waits until the picture has this many samples per pixel.
struct WaitStep {
    std::uint32_t samples = 1;
};
struct QuitStep {};

using RecordedStep = std::variant<InputEvent, ScreenshotStep, WaitStep, QuitStep>;

struct RecordedEvent {
    std::uint32_t frame = 0; ///< the step happens before this frame is drawn; the first frame is 0
    RecordedStep step;
};

struct Recording {
    ResizeEvent window; ///< initial size; not minimised
    std::vector<RecordedEvent> events;
};

// Limits of the reader; the writer clamps to them.
constexpr std::uint32_t kMaxRecordedFrame = 10'000'000; // four days at 30 per second
constexpr std::size_t kMaxRecordedEvents = 1'000'000;
constexpr std::size_t kMaxRecordingBytes = std::size_t(64) << 20;
constexpr std::uint32_t kMaxWindowSide = kMaxPixelSide;
constexpr double kMinWindowScale = 0.1, kMaxWindowScale = 16;
constexpr double kMaxCursor = 1e6; // window units
constexpr double kMaxWheel = 1000;
constexpr std::uint32_t kMaxWait = 65536; // the maximum of a picture
constexpr std::size_t kMaxDropped = 1024, kMaxPathBytes = 4096, kMaxNameBytes = 100;

/// Throws Error kBadInput "PATH:LINE: reason", or without the line if the file cannot be read.
Recording readRecording(const std::string& path);
/// The same for the text of a file; path is for messages.
Recording parseRecording(std::string_view text, const std::string& path);

/// The first line of a recording, and the line of an event, each with \n. Values out of range are clamped to the limits
/// above. Returns "" if nothing of the event can be recorded.
std::string recordingHeader(const ResizeEvent& window);
std::string recordingLine(const RecordedEvent& event);

struct CloseFile {
    void operator()(std::FILE* file) const { std::fclose(file); }
};

/// record flushes every line, so the file is complete after a crash.
struct RecordingWriter {
    std::string path;
    std::unique_ptr<std::FILE, CloseFile> file;
    std::uint32_t last_frame = 0;
};

/// Overwrites path. Throws Error kCannotWrite "PATH: reason", as record does.
RecordingWriter openRecording(const std::string& path, const ResizeEvent& window);
/// Moves events of frames before the last recorded one to that frame.
void record(RecordingWriter& writer, RecordedEvent event);

} // namespace pointrt
