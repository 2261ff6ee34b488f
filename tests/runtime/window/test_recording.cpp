// SPDX-License-Identifier: Apache-2.0
#include "runtime/window/input/recording.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <random>

#include "format/base/error.h"
#include "runtime/window/input/recording_words.h"
#include "tests/support/says.h"
#include "tests/support/temporary_folder.h"

namespace pointrt {
namespace {

const std::string kHeader = "pointrt-recording 1 window 1280x720 scale 1\n";

template <typename Step>
Step only(const std::string& line) {
    const Recording recording = parseRecording(kHeader + line + "\n", "r");
    EXPECT_EQ(recording.events.size(), 1U);
    const RecordedStep& step = recording.events.at(0).step;
    if constexpr (std::is_constructible_v<RecordedStep, Step> && !std::is_constructible_v<InputEvent, Step>)
        return std::get<Step>(step);
    else
        return std::get<Step>(std::get<InputEvent>(step));
}

std::string recordingErrorOf(const std::string& text) {
    try {
        parseRecording(text, "a.rec");
        return "";
    } catch (const Error& error) {
        EXPECT_EQ(error.code, ExitCode::kBadInput);
        return error.what();
    }
}

std::string errorOfLine(const std::string& line) { return recordingErrorOf(kHeader + line); }

/// The recording as text. Lines are exact, so equal texts mean equal recordings.
std::string textOf(const Recording& recording) {
    std::string text = recordingHeader(recording.window);
    for (const RecordedEvent& event : recording.events) text += recordingLine(event);
    return text;
}

TEST(Recording, ReadsEveryKindOfLine) {
    EXPECT_EQ(only<KeyEvent>("3 key down F12").key, Key::kF12);
    EXPECT_FALSE(only<KeyEvent>("3 key up w").down);
    EXPECT_EQ(only<KeyEvent>("3 key up w").key, keyOf('W'));
    EXPECT_EQ(only<TextEvent>("3 text \"\xc3\xa9\"").code_point, 0xE9U);
    EXPECT_EQ(only<ButtonEvent>("3 button down right").button, MouseButton::kRight);
    EXPECT_EQ(only<CursorEvent>("3 cursor -1.5 7e2").y, 700);
    EXPECT_EQ(only<WheelEvent>("3 wheel 0 -0.25").y, -0.25);
    EXPECT_EQ(only<ResizeEvent>("3 resize 640x480 scale 1.5").scale, 1.5);
    EXPECT_EQ(only<ResizeEvent>("3 resize 0x0 scale 1").width, 0U);
    EXPECT_EQ(only<DropEvent>(R"(3 drop "/a b/\"c\".pro" "\x41\n\\ # no comment" # comment)").paths,
              (std::vector<std::string>{"/a b/\"c\".pro", "A\n\\ # no comment"}));
    only<CloseEvent>("3 close");
    EXPECT_EQ(only<ScreenshotStep>("3 screenshot after-turn.1").name, "after-turn.1");
    EXPECT_EQ(only<WaitStep>("3 wait 16").samples, 16U);
    only<QuitStep>("3 quit");
}

TEST(Recording, AcceptsHandEditedFiles) {
    const Recording recording = parseRecording("# what\n\n\tpointrt-recording 1   window 64x48 scale 2 # small\r\n"
                                               "0 text \"hi\"\r\n   # turn\n0 wait 1\n7\tquit",
                                               "r");
    EXPECT_EQ(recording.window.width, 64U);
    EXPECT_EQ(recording.window.height, 48U);
    EXPECT_EQ(recording.window.scale, 2);
    ASSERT_EQ(recording.events.size(), 4U);
    EXPECT_EQ(std::get<TextEvent>(std::get<InputEvent>(recording.events[1].step)).code_point, U'i');
    EXPECT_EQ(recording.events[3].frame, 7U);
}

TEST(Recording, ErrorsHaveLineAndReason) {
    EXPECT_SAYS(recordingErrorOf(""), "a.rec: *empty");
    EXPECT_SAYS(recordingErrorOf("# nothing\n"), "a.rec: *empty");
    EXPECT_SAYS(recordingErrorOf("\nhello\n"), "a.rec:2: *pointrt-recording");
    EXPECT_SAYS(recordingErrorOf("pointrt-recording 2 window 1x1 scale 1"), "a.rec:1: *version \"2\"");
    EXPECT_SAYS(recordingErrorOf("pointrt-recording 1 window 0x0 scale 1"), "a.rec:1: *window *size");
    EXPECT_SAYS(recordingErrorOf("pointrt-recording 1 window 99999x1 scale 1"), "a.rec:1: \"99999x1\" *WxH *16384");
    EXPECT_SAYS(errorOfLine("5 quit\n4 quit"), "a.rec:3: *4 *5");
    EXPECT_SAYS(errorOfLine("x quit"), "a.rec:2: \"x\" *0 *10000000");
    EXPECT_SAYS(errorOfLine("1 jump"),
                "a.rec:2: \"jump\" *key, text, button, cursor, wheel, resize, drop, close, screenshot, wait, quit");
    EXPECT_SAYS(errorOfLine("1 key down Foo"), "a.rec:2: *key \"Foo\"");
    EXPECT_SAYS(errorOfLine("1 key sideways A"), "a.rec:2: \"sideways\" *down *up");
    EXPECT_SAYS(errorOfLine("1 button down thumb"), "a.rec:2: *button \"thumb\"");
    EXPECT_SAYS(errorOfLine("1 cursor 1"), "a.rec:2: *FRAME cursor X Y");
    EXPECT_SAYS(errorOfLine("1 cursor 1 2 3"), "a.rec:2: *FRAME cursor X Y");
    EXPECT_SAYS(errorOfLine("1 cursor 1 nan"), "a.rec:2: \"nan\" *-1e+06 *1e+06");
    EXPECT_SAYS(errorOfLine("1 drop a.pro"), "a.rec:2: *FRAME drop \"PATH\" ...");
    EXPECT_SAYS(errorOfLine("1 drop \"a.pro"), "a.rec:2: *quote");
    EXPECT_SAYS(errorOfLine("1 text \"\xff\""), "a.rec:2: *UTF-8");
}

TEST(Recording, RejectsDangerousInput) {
    const std::string too_long(101, 'a');
    for (const std::string& line :
         {std::string("99999999999 quit"), std::string("10000001 quit"), std::string("1 wait 0"),
          std::string("1 wait 65537"), std::string("1 cursor 1e7 0"), std::string("1 wheel 0 1e9"),
          std::string("1 resize 16385x1 scale 1"), std::string("1 resize 10x10 scale 0"),
          std::string("1 resize 0x5 scale 1"), std::string("1 screenshot ../../etc/passwd"),
          std::string("1 screenshot .hidden"), "1 screenshot " + too_long, "1 drop \"" + std::string(5000, 'a') + "\"",
          std::string("1 drop \"\\q\""), std::string("1 drop \"\\x4\""), std::string("1 drop \"a\"b"),
          std::string("1 drop a\"b\""), std::string("1 drop \"\\"), std::string("1 key down \"A\"")})
        EXPECT_NE(errorOfLine(line), "") << line;
    std::string many = "1 drop";
    for (int i = 0; i < 1025; ++i) many += " \"a\"";
    EXPECT_SAYS(errorOfLine(many), "a.rec:2: *paths");
    EXPECT_SAYS(recordingErrorOf(kHeader + "1 text \"" + std::string(kMaxRecordedEvents + 1, 'a') + "\""),
                "a.rec:2: *1000000 events");
    EXPECT_SAYS(recordingErrorOf(std::string(kMaxRecordingBytes + 1, '\n')), "a.rec: *64 MiB");
}

TEST(Recording, KeyNamesRoundTrip) {
    for (unsigned value = 0; value < 400; ++value) {
        const Key key = static_cast<Key>(value);
        const std::string name = keyName(key);
        const std::optional<Key> back = keyNamed(name);
        ASSERT_TRUE(back) << value;
        EXPECT_EQ(*back, name == "Unknown" ? Key::kUnknown : key);
        const std::string line = recordingLine({0, InputEvent{KeyEvent{key, true}}});
        EXPECT_EQ(textOf(parseRecording(kHeader + line, "r")), kHeader + line);
    }
    for (Key key : {Key::kEscape, Key::kAlt, Key::kF1, Key::kF12, Key::kSpace, keyOf('A'), keyOf('9'), keyOf('#')})
        EXPECT_NE(keyName(key), "Unknown");
}

std::string randomBytes(std::mt19937& random, std::size_t most) {
    std::string bytes(random() % most + 1, '\0');
    for (char& byte : bytes) byte = static_cast<char>(random() % 3 ? ' ' + random() % 95 : random());
    return bytes;
}

RecordedStep randomStep(std::mt19937& random) {
    std::uniform_real_distribution<double> cursor(-2000, 2000), wheel(-3, 3);
    const bool down = random() % 2 == 0;
    switch (random() % 10) {
    case 0:
        return InputEvent{KeyEvent{keyOf(static_cast<char>('A' + random() % 26)), down}};
    case 1:
        return InputEvent{TextEvent{static_cast<std::uint32_t>(random() % 0x11FFFF)}};
    case 2:
        return InputEvent{ButtonEvent{static_cast<MouseButton>(random() % 3), down}};
    case 3:
        return InputEvent{CursorEvent{cursor(random), cursor(random)}};
    case 4:
        return InputEvent{WheelEvent{wheel(random), wheel(random)}};
    case 5:
        return InputEvent{ResizeEvent{static_cast<std::uint32_t>(random() % 2000 + 1), 700, 1.25}};
    case 6:
        return InputEvent{DropEvent{{randomBytes(random, 60), randomBytes(random, 60)}}};
    case 7:
        return InputEvent{CloseEvent{}};
    case 8:
        return ScreenshotStep{"shot-" + std::to_string(random() % 100)};
    default:
        return WaitStep{static_cast<std::uint32_t>(random() % 64 + 1)};
    }
}

Recording randomRecording(std::mt19937& random, int events) {
    Recording recording;
    recording.window = {1280, 720, 1.5};
    std::uint32_t frame = 0;
    for (int i = 0; i < events; ++i) recording.events.push_back({frame += random() % 3, randomStep(random)});
    recording.events.push_back({frame, QuitStep{}});
    return recording;
}

TEST(Recording, RoundTrips) {
    std::mt19937 random(5);
    const Recording recording = randomRecording(random, 3000);
    const std::string text = textOf(recording);
    const Recording back = parseRecording(text, "r");
    ASSERT_EQ(back.events.size(), recording.events.size());
    EXPECT_EQ(textOf(back), text);
    for (std::size_t i = 0; i < back.events.size(); ++i) {
        EXPECT_EQ(back.events[i].frame, recording.events[i].frame);
        ASSERT_EQ(back.events[i].step.index(), recording.events[i].step.index());
        const auto* before = std::get_if<InputEvent>(&recording.events[i].step);
        if (before == nullptr) continue;
        const InputEvent& after = std::get<InputEvent>(back.events[i].step);
        ASSERT_EQ(before->index(), after.index());
        if (const auto* drop = std::get_if<DropEvent>(before)) {
            EXPECT_EQ(drop->paths, std::get<DropEvent>(after).paths);
        }
        if (const auto* cursor = std::get_if<CursorEvent>(before)) {
            EXPECT_EQ(cursor->x, std::get<CursorEvent>(after).x); // exactly
        }
    }
}

TEST(Recording, CharactersRoundTrip_InvalidOnesAreReplaced) {
    for (std::uint32_t c :
         {0x0U, 0x41U, 0x22U, 0x5CU, 0x7FU, 0x80U, 0x7FFU, 0x800U, 0x2028U, 0xFFFFU, 0x10000U, 0x10FFFFU})
        EXPECT_EQ(only<TextEvent>("0 text " + quotedText(utf8Of(c))).code_point, c);
    for (std::uint32_t c : {0xD800U, 0xDFFFU, 0x110000U, 0xFFFFFFFFU})
        EXPECT_EQ(only<TextEvent>("0 text " + quotedText(utf8Of(c))).code_point, 0xFFFDU);
    for (const char* bad : {"\xc0\x80", "\xe0\x80\x80", "\xed\xa0\x80", "\xf5\x80\x80\x80", "\x80", "\xe2\x82"})
        EXPECT_NE(errorOfLine(std::string("0 text \"") + bad + "\""), "");
}

TEST(Recording, WriterOutputIsReadable) {
    const double infinity = std::numeric_limits<double>::infinity();
    DropEvent heap;
    heap.paths.assign(2000, "a");
    heap.paths[3] = std::string(9000, 'a');
    const InputEvent odd[] = {CursorEvent{std::nan(""), infinity},
                              WheelEvent{-infinity, 1e300},
                              ResizeEvent{4000000000U, 5, -1},
                              ResizeEvent{5, 0, std::nan("")},
                              KeyEvent{static_cast<Key>(9999), true},
                              ButtonEvent{static_cast<MouseButton>(77), true},
                              TextEvent{0xFFFFFFFF},
                              DropEvent{},
                              DropEvent{{std::string("\n\"\\\0#\xff\xc3\xa9", 9)}},
                              heap};
    for (const InputEvent& event : odd)
        EXPECT_EQ(errorOfLine(recordingLine({4000000000U, event})), "") << event.index();
    EXPECT_EQ(recordingErrorOf(recordingHeader({0, 0, 1e9})), "");
    EXPECT_EQ(errorOfLine(recordingLine({1, WaitStep{0}})), "");
}

class RecordingFile : public testing::Test {
protected:
    const test::TemporaryFolder owned;
    const std::filesystem::path& folder = owned.path;
};

TEST_F(RecordingFile, FlushesEveryLine) {
    const std::string path = folder / "a.rec";
    RecordingWriter writer = openRecording(path, {640, 480, 1});
    EXPECT_EQ(readRecording(path).events.size(), 0U);
    for (std::uint32_t frame : {0U, 5U, 3U}) {
        record(writer, {frame, InputEvent{CursorEvent{1, 2}}});
        EXPECT_EQ(readRecording(path).events.back().frame, frame == 0 ? 0U : 5U); // frames never decrease
    }
    const RecordingWriter moved = std::move(writer);
    EXPECT_EQ(readRecording(path).events.size(), 3U);
    EXPECT_EQ(readRecording(path).window.width, 640U);
}

TEST_F(RecordingFile, ReportsFileErrors) {
    const std::string missing = folder / "none" / "a.rec";
    EXPECT_THROW(readRecording(missing), Error);
    EXPECT_THROW(readRecording(folder), Error);
    try {
        openRecording(missing, {640, 480, 1});
        FAIL();
    } catch (const Error& error) {
        EXPECT_EQ(error.code, ExitCode::kCannotWrite);
        EXPECT_EQ(std::string(error.what()), missing + ": No such file or directory");
    }
    if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "no full disk here";
    EXPECT_THROW(openRecording("/dev/full", {640, 480, 1}), Error);
}

std::string mutatedRecording(std::string text, std::mt19937& random) {
    const unsigned changes = random() % 8 + 1;
    for (unsigned i = 0; i < changes && !text.empty(); ++i) {
        const std::size_t at = random() % text.size();
        switch (random() % 5) {
        case 0:
            text[at] = static_cast<char>(random());
            break;
        case 1:
            text.erase(at, random() % 20);
            break;
        case 2:
            text.insert(at, randomBytes(random, 8));
            break;
        case 3:
            text.resize(at);
            break;
        default:
            text.insert(at, text.substr(random() % text.size(), 40));
            break;
        }
    }
    return text;
}

TEST(Recording, MutationsAreReadOrRejected) {
    std::mt19937 random(6);
    const std::string text = textOf(randomRecording(random, 40));
    int read = 0;
    for (int i = 0; i < 2000; ++i) {
        try {
            const std::string again = textOf(parseRecording(mutatedRecording(text, random), "r"));
            EXPECT_EQ(textOf(parseRecording(again, "r")), again);
            ++read;
        } catch (const Error& error) {
            EXPECT_EQ(error.code, ExitCode::kBadInput);
            EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
        }
    }
    EXPECT_GT(read, 20);
    EXPECT_LT(read, 1980);
}

} // namespace
} // namespace pointrt
