// SPDX-License-Identifier: Apache-2.0
// Balls among the splats of a file: the bit that marks them, the flag that allows it, and the version.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "expect_found.h"
#include "tests/support/temporary_folder.h"
#include "tiny_scene.h"

namespace pointrt::test {
namespace {

constexpr std::size_t kBall = 2; ///< the splat that is a ball

Scene sceneWithBall() {
    Scene scene = tinyScene();
    pro_splat_set_ball(&scene.splats[kBall * PRO_SPLAT_WORDS]);
    scene.info.flags |= PRO_FLAG_BALLS;
    return scene;
}

Bytes bytesWith(Scene scene) {
    const TemporaryFolder folder;
    const std::string path = folder.file("balls.pro");
    scene.write(path);
    return readBytes(path);
}

TEST(Balls, AreOneBitOfASplat) {
    const pro_splat splat{{0.1f, 0.9f, 0.7f}, {0.6f, 0, -0.8f}, 0.03f, {1, 2, 3}, 4};
    std::array<std::uint32_t, PRO_SPLAT_WORDS> disc, ball;
    pro_splat_encode(&splat, 0.25f, 0.03125f, disc.data());
    EXPECT_EQ(pro_splat_is_ball(disc.data()), 0);
    ball = disc;
    pro_splat_set_ball(ball.data());
    EXPECT_EQ(pro_splat_is_ball(ball.data()), 1);
    EXPECT_EQ(ball[1], disc[1] | PRO_SPLAT_BALL);
    pro_splat from_disc, from_ball;
    pro_splat_decode(disc.data(), 0.25f, 0.03125f, &from_disc);
    pro_splat_decode(ball.data(), 0.25f, 0.03125f, &from_ball);
    EXPECT_TRUE(std::equal(std::begin(from_disc.position), std::end(from_disc.position), from_ball.position));
    EXPECT_EQ(from_disc.radius, from_ball.radius);
}

TEST(Balls, AreReadBack) {
    const Bytes bytes = bytesWith(sceneWithBall());
    EXPECT_TRUE(findingsOf(bytes).empty());
    pro_file* file = nullptr;
    ASSERT_EQ(pro_open_memory(bytes.data(), bytes.size(), 0, &file, nullptr), PRO_OK);
    pro_info info;
    pro_view view;
    pro_get_info(file, &info);
    pro_get_view(file, &view);
    EXPECT_EQ(info.version_minor, 5u);
    EXPECT_NE(info.flags & PRO_FLAG_BALLS, 0u);
    for (std::size_t i = 0; i < info.splat_count; ++i)
        EXPECT_EQ(pro_splat_is_ball(view.splats + i * PRO_SPLAT_WORDS), i == kBall ? 1 : 0);
    pro_close(file);
}

TEST(Balls, NeedTheFlag) {
    const Bytes bytes = bytesWith(sceneWithBall());
    expectFound(bytes, PRO_OFF_FLAGS, std::uint32_t{PRO_FLAG_COLOR | PRO_FLAG_ORIENTED}, 5001);
    Scene scene = sceneWithBall();
    scene.info.flags &= ~PRO_FLAG_BALLS;
    pro_message message{};
    const pro_view view = scene.view();
    const TemporaryFolder folder;
    const std::string path = folder.file("balls.pro");
    EXPECT_EQ(pro_write(path.c_str(), &scene.info, &view, &message), PRO_BAD_ARGUMENT);
    EXPECT_EQ(message.finding, 5001u);
}

/// Tiles of a set may have the flag without a ball.
TEST(Balls, MayBeAbsent) {
    Scene scene = tinyScene();
    scene.info.flags |= PRO_FLAG_BALLS;
    EXPECT_TRUE(findingsOf(bytesWith(scene)).empty());
}

TEST(Balls, DoNotChangeFilesWithoutThem) {
    const Bytes bytes = bytesWith(tinyScene());
    EXPECT_EQ(loadAt<std::uint32_t>(bytes, PRO_OFF_VERSION_MINOR), 0u);
    EXPECT_EQ(loadAt<std::uint32_t>(bytes, PRO_OFF_FLAGS) & PRO_FLAG_BALLS, 0u);
}

} // namespace
} // namespace pointrt::test
