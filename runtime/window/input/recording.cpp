// SPDX-License-Identifier: Apache-2.0
#include "runtime/window/input/recording.h"

#include <cerrno>
#include <cstring>
#include <optional>
#include <stdexcept>
#include <utility>

#include "format/base/error.h"
#include "format/base/printable.h"
#include "runtime/util/parse.h"
#include "runtime/util/words.h"
#include "runtime/window/input/recording_words.h"

namespace pointrt {
namespace {

using Words = std::vector<RecordingWord>;
using Steps = std::vector<RecordedStep>;

[[noreturn]] void refuseRecording(const std::string& reason) { throw std::invalid_argument(reason); }

/// Takes a line's words after frame and kind, one by one.
struct Arguments {
    const Words& words;
    std::size_t next;
    std::string usage; ///< for messages

    bool isDone() const { return next == words.size(); }

    const RecordingWord& take(bool in_quotes) {
        if (isDone() || words[next].in_quotes != in_quotes) refuseRecording("does not match: " + usage);
        return words[next++];
    }
    std::string word() { return take(false).text; }
    std::string string() { return take(true).text; }
    void requireWord(const char* expected) {
        if (word() != expected) refuseRecording("does not match: " + usage);
    }
    void requireDone() const {
        if (!isDone()) refuseRecording("does not match: " + usage);
    }
};

double takeReal(Arguments& arguments, double low, double high) { return parseReal(arguments.word(), low, high); }

bool takeDown(Arguments& arguments) {
    const std::string word = arguments.word();
    if (word != "down" && word != "up") refuseRecording(quotedWord(word) + " must be down or up");
    return word == "down";
}

/// "WxH scale S"; 0x0 is a minimised window.
ResizeEvent takeSize(Arguments& arguments) {
    const std::string word = arguments.word();
    ResizeEvent size;
    const PixelSize pixels = word == "0x0" ? PixelSize{} : parseSize(word, kMaxWindowSide);
    size.width = pixels.width;
    size.height = pixels.height;
    arguments.requireWord("scale");
    size.scale = takeReal(arguments, kMinWindowScale, kMaxWindowScale);
    return size;
}

KeyEvent takeKey(Arguments& arguments) {
    const bool down = takeDown(arguments);
    const std::string name = arguments.word();
    const std::optional<Key> key = keyNamed(name);
    if (!key) refuseRecording("unknown key " + quotedWord(name));
    return {*key, down};
}

ButtonEvent takeButton(Arguments& arguments) {
    const bool down = takeDown(arguments);
    const std::string name = arguments.word();
    const std::optional<MouseButton> button = buttonNamed(name);
    if (!button) refuseRecording("unknown button " + quotedWord(name));
    return {*button, down};
}

DropEvent takeDrop(Arguments& arguments) {
    DropEvent drop;
    do {
        drop.paths.push_back(arguments.string());
        if (drop.paths.back().size() > kMaxPathBytes) refuseRecording("a path is too long");
        if (drop.paths.size() > kMaxDropped) refuseRecording("too many paths");
    } while (!arguments.isDone());
    return drop;
}

ScreenshotStep takeScreenshot(Arguments& arguments) {
    const std::string name = arguments.word();
    const bool plain = name.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789._-") ==
                       std::string::npos;
    if (!plain || name[0] == '.' || name.size() > kMaxNameBytes)
        refuseRecording(quotedWord(name) + " is not a picture name (letters, digits, . _ -)");
    return {name};
}

/// Constructs a step in place: GCC 12 warns falsely about uninitialised alternatives when variants are moved.
template <typename Event>
void add(Steps& steps, Event event) {
    steps.emplace_back(std::in_place_type<InputEvent>, std::in_place_type<Event>, std::move(event));
}

void takeText(Arguments& arguments, Steps& steps) {
    const std::string typed = arguments.string();
    std::string_view rest = typed;
    while (!rest.empty()) {
        const std::optional<std::uint32_t> code_point = takeCodePoint(rest);
        if (!code_point) refuseRecording("the text is not UTF-8");
        add(steps, TextEvent{*code_point});
    }
}

CursorEvent takeCursor(Arguments& arguments) {
    const double x = takeReal(arguments, -kMaxCursor, kMaxCursor);
    return {x, takeReal(arguments, -kMaxCursor, kMaxCursor)};
}

WheelEvent takeWheel(Arguments& arguments) {
    const double x = takeReal(arguments, -kMaxWheel, kMaxWheel);
    return {x, takeReal(arguments, -kMaxWheel, kMaxWheel)};
}

struct Kind {
    const char* name;
    const char* usage;
    void (*take)(Arguments&, Steps&);
};
const Kind kKinds[] = {
    {"key", "FRAME key down|up NAME", [](Arguments& a, Steps& s) { add(s, takeKey(a)); }},
    {"text", "FRAME text \"TYPED\"", takeText},
    {"button", "FRAME button down|up left|right|middle", [](Arguments& a, Steps& s) { add(s, takeButton(a)); }},
    {"cursor", "FRAME cursor X Y", [](Arguments& a, Steps& s) { add(s, takeCursor(a)); }},
    {"wheel", "FRAME wheel X Y", [](Arguments& a, Steps& s) { add(s, takeWheel(a)); }},
    {"resize", "FRAME resize WxH scale S", [](Arguments& a, Steps& s) { add(s, takeSize(a)); }},
    {"drop", "FRAME drop \"PATH\" ...", [](Arguments& a, Steps& s) { add(s, takeDrop(a)); }},
    {"close", "FRAME close", [](Arguments&, Steps& s) { add(s, CloseEvent{}); }},
    {"screenshot", "FRAME screenshot NAME", [](Arguments& a, Steps& s) { s.emplace_back(takeScreenshot(a)); }},
    {"wait", "FRAME wait SAMPLES",
     [](Arguments& a, Steps& s) { s.emplace_back(WaitStep{parseCount(a.word(), 1, kMaxWait)}); }},
    {"quit", "FRAME quit", [](Arguments&, Steps& s) { s.emplace_back(QuitStep{}); }},
};

const Kind& kindNamed(const std::string& name) {
    std::string names;
    for (const Kind& kind : kKinds) {
        if (name == kind.name) return kind;
        names += (names.empty() ? "" : ", ") + std::string(kind.name);
    }
    refuseRecording(quotedWord(name) + " is not one of " + names);
}

ResizeEvent headerOf(const Words& words) {
    Arguments arguments{words, 0, "pointrt-recording 1 window WxH scale S"};
    if (arguments.word() != "pointrt-recording")
        refuseRecording("not a recording: it must begin with pointrt-recording");
    const std::string version = arguments.word();
    if (version != "1") refuseRecording("unsupported version " + quotedWord(version) + " (this program reads 1)");
    arguments.requireWord("window");
    const ResizeEvent window = takeSize(arguments);
    arguments.requireDone();
    if (window.width == 0) refuseRecording("the window has no size");
    return window;
}

void addEvents(const Words& words, Recording& recording) {
    Arguments arguments{words, 0, "FRAME KIND ..."};
    const std::uint32_t frame = parseCount(arguments.word(), 0, kMaxRecordedFrame);
    if (!recording.events.empty() && frame < recording.events.back().frame)
        refuseRecording("frame " + std::to_string(frame) + " follows frame " +
                        std::to_string(recording.events.back().frame));
    const std::string name = arguments.word();
    const Kind& kind = kindNamed(name);
    arguments.usage = kind.usage;
    Steps steps;
    kind.take(arguments, steps);
    arguments.requireDone();
    if (recording.events.size() + steps.size() > kMaxRecordedEvents)
        refuseRecording("more than " + std::to_string(kMaxRecordedEvents) + " events");
    for (RecordedStep& step : steps) recording.events.push_back({frame, std::move(step)});
}

/// Removes and returns the first line of text.
std::string_view takeLine(std::string_view& text) {
    const std::size_t end = text.find('\n');
    const std::string_view line = text.substr(0, end);
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    return line;
}

} // namespace

Recording parseRecording(std::string_view text, const std::string& path) {
    if (text.size() > kMaxRecordingBytes) throw Error{ExitCode::kBadInput, path + ": larger than 64 MiB"};
    Recording recording;
    bool has_header = false;
    for (std::size_t number = 1; !text.empty(); ++number) {
        try {
            const Words words = recordingWords(takeLine(text));
            if (words.empty()) continue;
            if (has_header)
                addEvents(words, recording);
            else
                recording.window = headerOf(words);
            has_header = true;
        } catch (const std::invalid_argument& error) {
            throw Error{ExitCode::kBadInput, path + ":" + std::to_string(number) + ": " + error.what()};
        }
    }
    if (!has_header) throw Error{ExitCode::kBadInput, path + ": not a recording: the file is empty"};
    return recording;
}

Recording readRecording(const std::string& path) {
    const std::unique_ptr<std::FILE, CloseFile> file(std::fopen(path.c_str(), "rb"));
    std::string text;
    char block[65536];
    // pipes and devices have no known size
    while (file && text.size() <= kMaxRecordingBytes) {
        const std::size_t count = std::fread(block, 1, sizeof block, file.get());
        text.append(block, count);
        if (count < sizeof block) break;
    }
    if (!file || std::ferror(file.get())) throw Error{ExitCode::kBadInput, path + ": " + std::strerror(errno)};
    return parseRecording(text, path);
}

} // namespace pointrt
