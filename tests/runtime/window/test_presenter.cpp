// SPDX-License-Identifier: Apache-2.0
// Presentation without a screen: uploads are read back, with the UI on top. With the validation layer; any message
// fails.
#include <gtest/gtest.h>

#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <random>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "format/base/error.h"
#include "runtime/window/platform/key_names.h"
#include "runtime/window/platform/platform.h"
#include "runtime/window/platform/presenter.h"
#include "runtime/window/ui/ui_input.h"
#include "tests/support/validated_device.h"

namespace pointrt {
namespace {

/// Random pixels, 0xAARRGGBB, that differ in every channel.
std::vector<std::uint32_t> testPixels(std::uint32_t width, std::uint32_t height, std::uint32_t seed = 1) {
    std::minstd_rand random(seed);
    std::vector<std::uint32_t> pixels(std::size_t(width) * height);
    for (std::uint32_t& pixel : pixels) pixel = 0xff000000u | (random() & 0xffffffu);
    return pixels;
}

double channelOf(std::uint32_t pixel, std::size_t channel) { return pixel >> (16 - 8 * channel) & 0xffu; }

std::vector<std::uint8_t> rgbOf(const std::vector<std::uint32_t>& pixels) {
    std::vector<std::uint8_t> rgb;
    for (std::uint32_t pixel : pixels)
        for (std::size_t c = 0; c < 3; ++c) rgb.push_back(static_cast<std::uint8_t>(channelOf(pixel, c)));
    return rgb;
}

/// The two pixels around a position along an axis, and the weight of the second.
struct Between {
    std::size_t first, second;
    double share;
};

Between between(std::size_t to, std::size_t to_size, std::size_t size) {
    const double position = (static_cast<double>(to) + 0.5) * static_cast<double>(size) / static_cast<double>(to_size);
    const double clamped = std::clamp(position - 0.5, 0.0, static_cast<double>(size - 1));
    const auto first = static_cast<std::size_t>(clamped);
    return {first, std::min(first + 1, size - 1), clamped - static_cast<double>(first)};
}

/// The largest difference between picture and a bilinear upscaling of small (of this width).
double bilinearError(const Image8& picture, const std::vector<std::uint32_t>& small, std::size_t width) {
    double worst = 0;
    for (std::size_t i = 0; i < picture.pixels.size(); ++i) {
        const std::size_t x = i / 3 % picture.width, y = i / 3 / picture.width;
        const Between column = between(x, picture.width, width), row = between(y, picture.height, small.size() / width);
        const auto at = [&](std::size_t c, std::size_t r) { return channelOf(small[r * width + c], i % 3); };
        const double upper = std::lerp(at(column.first, row.first), at(column.second, row.first), column.share);
        const double lower = std::lerp(at(column.first, row.second), at(column.second, row.second), column.share);
        worst = std::max(worst, std::abs(std::lerp(upper, lower, row.share) - picture.pixels[i]));
    }
    return worst;
}

DeviceRequest withGraphics() {
    DeviceRequest request;
    request.graphics = true;
    return request;
}

class PresenterTest : public DeviceFixture {
protected:
    PresenterTest() : DeviceFixture(withGraphics()) {}
    void SetUp() override {
        presenter = createPresenter(device, VK_NULL_HANDLE, kWidth, kHeight);
        ImGui::CreateContext();
        ImGui::GetIO().IniFilename = nullptr;
        setUpUiInput();
        setUiFont(device, presenter);
    }
    void TearDown() override {
        ImGui::DestroyContext();
        destroyPresenter(device, presenter);
    }

    template <typename Record>
    void upload(const std::vector<std::uint32_t>& pixels, Record&& record) {
        Buffer buffer = createFilledBuffer(device, "pixels", pixels.data(), pixels.size() * 4, 0);
        const VkCommandBuffer commands = beginCommands(device);
        record(commands, buffer);
        submitAndWait(device, commands);
        destroyBuffer(device, buffer);
    }
    void uploadAll(const std::vector<std::uint32_t>& pixels) {
        upload(pixels, [&](VkCommandBuffer commands, const Buffer& buffer) {
            recordUploadRows(commands, presenter, buffer, 0, presenter.canvas.extent.height);
        });
    }
    /// on_host: for devices that are CPUs.
    void uploadPicture(const std::vector<std::uint32_t>& pixels, std::uint32_t width, std::uint32_t height,
                       bool on_host) {
        upload(pixels, [&](VkCommandBuffer commands, const Buffer& buffer) {
            if (on_host)
                recordUploadPreview(device, commands, presenter, buffer, width, height);
            else
                recordUploadScaled(commands, presenter, buffer, width, height);
        });
    }

    /// A frame with an opaque red window at [left, left + 60) x [20, 60).
    const ImDrawData* drawWindow(float left) {
        const VkExtent2D size = presenter.canvas.extent;
        beginUiFrame(input, {size.width, size.height, 1}, 0.02);
        ImGui::SetNextWindowPos({left, 20});
        ImGui::SetNextWindowSize({60, 40});
        ImGui::PushStyleColor(ImGuiCol_WindowBg, ImVec4(1, 0, 0, 1));
        ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, 0);
        ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, 0);
        ImGui::Begin("window", nullptr, ImGuiWindowFlags_NoDecoration);
        ImGui::End();
        ImGui::PopStyleVar(2);
        ImGui::PopStyleColor();
        ImGui::Render();
        return ImGui::GetDrawData();
    }

    static constexpr std::uint32_t kWidth = 203, kHeight = 117;
    Presenter presenter;
    UiInput input;

private:
};

TEST_F(PresenterTest, BeginsBlack) {
    const Image8 picture = readCanvas(device, presenter);
    EXPECT_EQ(picture.width, kWidth);
    EXPECT_EQ(picture.height, kHeight);
    EXPECT_EQ(picture.pixels, std::vector<std::uint8_t>(std::size_t(kWidth) * kHeight * 3, 0));
}

TEST_F(PresenterTest, KeepsUploadedRows) {
    std::vector<std::uint32_t> pixels = testPixels(kWidth, kHeight);
    uploadAll(pixels);
    EXPECT_EQ(readCanvas(device, presenter).pixels, rgbOf(pixels));
    const std::vector<std::uint32_t> changed = testPixels(kWidth, kHeight, 2);
    upload(changed, [&](VkCommandBuffer commands, const Buffer& buffer) {
        recordUploadRows(commands, presenter, buffer, 10, 7);
        recordUploadRows(commands, presenter, buffer, kHeight - 1, 1);
        recordUploadRows(commands, presenter, buffer, 3, 0);
        EXPECT_THROW(recordUploadRows(commands, presenter, buffer, kHeight, 1), std::logic_error);
    });
    std::copy_n(changed.begin() + 10 * kWidth, 7 * kWidth, pixels.begin() + 10 * kWidth);
    std::copy_n(changed.end() - kWidth, kWidth, pixels.end() - kWidth);
    EXPECT_EQ(readCanvas(device, presenter).pixels, rgbOf(pixels));
}

// Vulkan requires blit weights of 1/16 or finer; drivers and the host code use 8 bits. That gives an error of half a
// step, 255 / 512, in each direction, and rounding adds half a step twice.
constexpr double kBilinearError = 2;

TEST_F(PresenterTest, UpscalesBilinearly) {
    constexpr std::uint32_t kSmallWidth = 41, kSmallHeight = 30;
    const std::vector<std::uint32_t> pixels = testPixels(kSmallWidth, kSmallHeight);
    for (bool on_host : {false, true}) {
        // noise of another size first, which must not appear at the edges
        uploadPicture(testPixels(kWidth, kHeight, 3), kWidth, kHeight, on_host);
        uploadPicture(pixels, kSmallWidth, kSmallHeight, on_host);
        EXPECT_LT(bilinearError(readCanvas(device, presenter), pixels, kSmallWidth), kBilinearError) << on_host;
    }
    EXPECT_THROW(recordUploadScaled(VK_NULL_HANDLE, presenter, {}, kWidth + 1, 1), std::logic_error);
    EXPECT_THROW(recordUploadPreview(device, VK_NULL_HANDLE, presenter, {}, 1, 0), std::logic_error);
}

TEST_F(PresenterTest, CanvasSizedPicturesAreCopied) {
    const std::vector<std::uint32_t> pixels = testPixels(kWidth, kHeight);
    for (bool on_host : {false, true}) {
        uploadPicture(pixels, kWidth, kHeight, on_host);
        EXPECT_EQ(readCanvas(device, presenter).pixels, rgbOf(pixels)) << on_host;
    }
}

TEST_F(PresenterTest, PresentsWithoutUi) {
    const std::vector<std::uint32_t> pixels = testPixels(kWidth, kHeight);
    uploadAll(pixels);
    EXPECT_TRUE(present(device, presenter, nullptr));
    EXPECT_EQ(readFrame(device, presenter, nullptr).pixels, rgbOf(pixels));
    const ImDrawData* ui = drawWindow(50);
    EXPECT_TRUE(present(device, presenter, ui));
    const Image8 frame = readFrame(device, presenter, ui);
    std::vector<std::uint8_t> expected = rgbOf(pixels);
    const std::uint8_t red[] = {255, 0, 0};
    for (std::size_t y = 20; y < 60; ++y)
        for (std::size_t x = 50; x < 110; ++x)
            std::copy_n(red, 3, expected.begin() + static_cast<long>(y * kWidth + x) * 3);
    EXPECT_EQ(frame.pixels, expected);
    EXPECT_EQ(readCanvas(device, presenter).pixels, rgbOf(pixels)) << "the UI must not get into the picture";
}

/// Frames one after another, each with its own triangles and pixels, which must not replace those that an earlier frame
/// still reads.
TEST_F(PresenterTest, FramesDoNotWaitForEachOther) {
    Buffer buffer = createBuffer(device, "pixels", 4 * kWidth * kHeight, 0);
    std::vector<std::uint32_t> pixels;
    for (std::uint32_t i = 0; i < 6; ++i) {
        pixels = testPixels(kWidth, kHeight, i);
        uploadBuffer(device, buffer, pixels.data(), 4 * pixels.size());
        EXPECT_TRUE(
            present(device, presenter, drawWindow(10.0f * static_cast<float>(i)),
                    [&](VkCommandBuffer commands) { recordUploadRows(commands, presenter, buffer, 0, kHeight); }));
    }
    EXPECT_EQ(readCanvas(device, presenter).pixels, rgbOf(pixels));
    destroyBuffer(device, buffer);
}

TEST_F(PresenterTest, DrawsGlyphs) {
    beginUiFrame(input, {kWidth, kHeight, 1}, 0.02);
    ImGui::GetForegroundDrawList()->AddText({10, 10}, IM_COL32(0, 255, 0, 255), "/");
    ImGui::Render();
    const Image8 frame = readFrame(device, presenter, ImGui::GetDrawData());
    std::size_t green = 0, others = 0, left = kWidth, right = 0;
    for (std::size_t i = 0; i < frame.pixels.size(); i += 3) {
        others += frame.pixels[i] != 0 || frame.pixels[i + 2] != 0;
        if (frame.pixels[i + 1] == 0) continue;
        ++green;
        left = std::min(left, i / 3 % kWidth);
        right = std::max(right, i / 3 % kWidth);
    }
    // a slanted stroke: several pixels high, a few wide, narrower than its box
    EXPECT_GT(right, left + 2);
    EXPECT_GT(green, 5u);
    EXPECT_LT(green, (right - left + 1) * 5) << "the glyph's box is filled: the font's coverage is not used";
    EXPECT_EQ(others, 0u);
}

TEST_F(PresenterTest, SurvivesRandomResizes) {
    std::mt19937 random(1);
    for (int i = 0; i < 200; ++i) {
        const auto width = static_cast<std::uint32_t>(1 + random() % 300), height = std::uint32_t(1 + random() % 300);
        resizeCanvas(device, presenter, width, height);
        const std::uint32_t small_width = 1 + std::uint32_t(random()) % width;
        const std::uint32_t small_height = 1 + std::uint32_t(random()) % height;
        if (i % 3 == 0) uploadPicture(testPixels(small_width, small_height), small_width, small_height, i % 2);
        if (i % 5 == 0) uploadAll(testPixels(width, height));
        EXPECT_TRUE(present(device, presenter, i % 2 ? drawWindow(-20) : nullptr));
    }
    resizeCanvas(device, presenter, 0, 0);
    EXPECT_GT(presenter.canvas.extent.width, 0u);
}

TEST_F(PresenterTest, ScalesTheLastPictureToANewSize) {
    uploadAll(std::vector<std::uint32_t>(std::size_t(kWidth) * kHeight, 0xff204060u));
    resizeCanvas(device, presenter, 64, 48);
    EXPECT_EQ(readCanvas(device, presenter).pixels, rgbOf(std::vector<std::uint32_t>(64 * 48, 0xff204060u)));
}

TEST_F(PresenterTest, SharesTheQueueWithWorkers) {
    Device worker = workerDevice(device);
    EXPECT_EQ(worker.queue, device.queue);
    EXPECT_NE(worker.command_pool, device.command_pool);
    ASSERT_NE(device.queue_mutex, nullptr);
    EXPECT_EQ(worker.queue_mutex, device.queue_mutex);
    const std::vector<std::uint32_t> words = testPixels(1000, 100);
    Buffer buffer;
    std::thread thread([&] {
        for (int i = 0; i < 50; ++i) {
            destroyBuffer(worker, buffer);
            buffer = createBuffer(worker, "words", words.size() * 4, 0);
            const VkCommandBuffer commands = beginCommands(worker);
            vkCmdFillBuffer(commands, buffer.handle, 0, VK_WHOLE_SIZE, 7);
            submitAndWait(worker, commands);
        }
    });
    for (int i = 0; i < 50; ++i) present(device, presenter, drawWindow(10));
    thread.join();
    destroyWorkerDevice(worker);
    std::vector<std::uint32_t> filled(words.size());
    downloadBuffer(device, buffer, filled.data(), buffer.bytes);
    EXPECT_EQ(filled, std::vector<std::uint32_t>(words.size(), 7));
    destroyBuffer(device, buffer);
}

// A click that starts and ends between two frames must be seen.
TEST_F(PresenterTest, UiSeesQuickClicksAndKeys) {
    bool clicked = false, entered = false, held = true;
    for (int frame = 0; frame < 5; ++frame) {
        feedImGui(input, CursorEvent{20, 20});
        if (frame == 2) { // ImGui hides a new window in its first frame
            feedImGui(input, ButtonEvent{MouseButton::kLeft, true});
            feedImGui(input, ButtonEvent{MouseButton::kLeft, false});
            feedImGui(input, KeyEvent{Key::kEnter, true});
            feedImGui(input, KeyEvent{Key::kEnter, false});
        }
        beginUiFrame(input, {kWidth, kHeight, 1}, 0.02);
        ImGui::SetNextWindowPos({0, 0});
        ImGui::Begin("window", nullptr, ImGuiWindowFlags_NoDecoration);
        clicked |= ImGui::Button("a button", {100, 60});
        held = ImGui::IsKeyDown(uiKey(Key::kEnter));
        entered |= ImGui::IsKeyPressed(uiKey(Key::kEnter));
        ImGui::End();
        ImGui::Render();
    }
    EXPECT_TRUE(clicked);
    EXPECT_TRUE(entered);
    EXPECT_FALSE(ImGui::GetIO().MouseDown[0]);
    EXPECT_FALSE(held);
}

TEST(Platform, ReportsWhyThereIsNoWindow) {
    for (const char* display : {"DISPLAY", "WAYLAND_DISPLAY"}) unsetenv(display);
    try {
        PlatformWindow window = createPlatformWindow(64, 64, "none");
        destroyPlatformWindow(window);
        FAIL() << "no error";
    } catch (const Error& error) {
        const std::string text = error.what();
        EXPECT_EQ(error.code, ExitCode::kCannotRun);
        EXPECT_NE(text.find("window"), std::string::npos) << text;
        EXPECT_NE(text.find("-o FILE"), std::string::npos) << text;
        EXPECT_EQ(text.find('\n'), std::string::npos) << text;
    }
}

TEST(KeyNames, FollowTheLayoutForLettersOnly) {
    constexpr int kQ = 'Q', kOne = '1', kF12 = 301, kKeypad5 = 325, kRightShift = 344, kCapsLock = 280;
    EXPECT_EQ(keyFromGlfw(kQ, "a"), keyOf('A')); // AZERTY
    EXPECT_EQ(keyFromGlfw(kOne, "&"), keyOf('1'));
    EXPECT_EQ(keyFromGlfw(kQ, "\xd0\xb9"), keyOf('Q')); // a Cyrillic letter
    EXPECT_EQ(keyFromGlfw(kQ, nullptr), keyOf('Q'));
    EXPECT_EQ(keyFromGlfw(kF12, nullptr), Key::kF12);
    EXPECT_EQ(keyFromGlfw(kKeypad5, "5"), keyOf('5'));
    EXPECT_EQ(keyFromGlfw(kRightShift, nullptr), Key::kShift);
    EXPECT_EQ(keyFromGlfw(kCapsLock, nullptr), Key::kUnknown);
}

} // namespace
} // namespace pointrt
