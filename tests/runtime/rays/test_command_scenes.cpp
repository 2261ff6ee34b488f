// SPDX-License-Identifier: Apache-2.0
// pointrt-rays cast on tile sets and scene files.
#include "tests/runtime/rays/cast_command.h"
#include "tests/runtime/rays/set_scenes.h"

namespace pointrt::test {
namespace {

class CastSets : public CastCommand {
protected:
    static void SetUpTestSuite() { ball = new SphereInTiles; }
    static void TearDownTestSuite() {
        delete ball;
        ball = nullptr;
    }
    CastSets() {
        folder.write("rays.npy", rayArray(raysAround(ball->center, 1.5 * SphereInTiles::kRadius, 20000, 1)));
        std::filesystem::create_directory_symlink(ball->tiles(), folder.file("ball.proset"));
    }
    std::map<std::string, std::string> arraysOf(const std::string& words) const {
        const Outcome result = run(POINTRT_RAYS " cast " + words + " --rays rays.npy -o out.npz --stats stats.json");
        EXPECT_EQ(result.code, 0) << result.err;
        return zipMembers(text("out.npz"));
    }
    static inline SphereInTiles* ball = nullptr;
};

TEST_F(CastSets, TilesAreAColumn) {
    const auto held = arraysOf("ball.proset --attributes number");
    EXPECT_EQ(readArray(held.at("tile_ids.npy")).header,
              "{'descr': '<u4', 'fortran_order': False, 'shape': (20000,), }");
    EXPECT_NE(text("stats.json").find("\"tile_loads\": " + std::to_string(ball->originals()) + ","), std::string::npos);
    const auto streamed = arraysOf("ball.proset --attributes number --memory " + std::to_string(ball->largestTile()));
    EXPECT_TRUE(held == streamed);
    const auto numbers = readArray(held.at("number.npy")).as<std::uint32_t>();
    EXPECT_GT(std::count_if(numbers.begin(), numbers.end(), [](std::uint32_t n) { return n != 0; }), 4000);
    folder.write("one.csv", "500000 4500000 300 0 0 -1\n");
    ASSERT_EQ(run(POINTRT_RAYS " cast ball.proset --rays one.csv -o one.csv.out.csv").code, 0);
    EXPECT_TRUE(text("one.csv.out.csv").starts_with("t_hit,splat_id,instance_id,tile_id,nx,ny,nz,x,y,z\n"));
    ASSERT_EQ(run(POINTRT_RAYS " cast ball.proset --rays one.csv -o one.ply").code, 0);
    EXPECT_NE(text("one.ply").find("property uint instance_id\nproperty uint tile_id\nproperty float nx\n"),
              std::string::npos);
}

TEST_F(CastSets, SceneFilesAreCast) {
    folder.write("scene.toml", "[[instance]]\nfile = \"ball.proset\"\n[[instance]]\nfile = \"plane.pro\"\n");
    folder.write("rays.csv", "500000 4500000 300 0 0 -1\n500090 4500090 300 0 0 -1\n");
    ASSERT_EQ(run(POINTRT_RAYS " cast scene.toml --rays rays.csv -o out.npz").code, 0);
    EXPECT_EQ(readArray(zipMembers(text("out.npz")).at("instance_ids.npy")).as<std::uint32_t>(),
              (std::vector<std::uint32_t>{0, 1}));
    folder.write("scene.toml", "[[instance]]\nfile = \"gone.pro\"\n");
    expectRefused(1, "scene.toml:2: key \"instance[0].file\": *\"gone.pro\"",
                  POINTRT_RAYS " cast scene.toml --rays rays.csv -o out.npz");
}

TEST_F(CastSets, ErrorsAreOneLine) {
    const std::string rest = " --rays rays.npy -o out.npz";
    expectRefused(2, "--memory: \"much\" *size*(see --help)", POINTRT_RAYS " cast ball.proset --memory much" + rest);
    const Outcome small = run(POINTRT_RAYS " cast ball.proset --memory 4K" + rest);
    EXPECT_EQ(small.code, 2) << small.err;
    std::filesystem::copy(ball->tiles(), folder.file("copy.proset"), std::filesystem::copy_options::recursive);
    std::string tile;
    for (const SetTile& each : ball->set.tiles)
        if (each.isOriginal()) tile = "copy.proset/" + each.file;
    std::filesystem::remove(folder.file(tile));
    expectRefused(1, tile + ": No such file or directory", POINTRT_RAYS " cast copy.proset" + rest);
}

} // namespace
} // namespace pointrt::test
