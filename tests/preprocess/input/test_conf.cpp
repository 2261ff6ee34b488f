// SPDX-License-Identifier: Apache-2.0
#include "tests/preprocess/input/input_fixture.h"

#include <sys/stat.h>

namespace pointrt {
namespace {

using ConfTest = InputTest;

/// A rotation by 90 degrees about +Z; its inverse takes +X to -Y.
const std::string kQuarterTurn = "0 0 0.70710678118654752 0.70710678118654752";

TEST_F(ConfTest, PosesInvertTheQuaternionThenTranslate) {
    write("a.xyz", "1 0 0\n2 0 0\n");
    const Cloud cloud = readText("s.conf", "camera 0 0 0 0 0 0 1\nmesh other 0 0 0 0 0 0 1\nbmesh a.xyz 10 20 30 " +
                                               kQuarterTurn + "\n");
    EXPECT_LT((world(cloud, 0) - Vec3d(10, 19, 30)).norm(), 1e-6);
    EXPECT_LT((world(cloud, 1) - Vec3d(10, 18, 30)).norm(), 1e-6);
}

TEST_F(ConfTest, NormalsRotateWithTheScan) {
    write("a.xyz", "1 0 0 1 0 0\n2 0 0 0 -1 0\n");
    const Cloud cloud = readText("s.conf", "bmesh a.xyz 10 20 30 " + kQuarterTurn + "\n");
    EXPECT_LT((cloud.normals[0] - Vec3f(0, -1, 0)).norm(), 1e-6);
    EXPECT_LT((cloud.normals[1] - Vec3f(-1, 0, 0)).norm(), 1e-6);
}

TEST_F(ConfTest, EachScanHasItsSensorAlongItsOwnZ) {
    write("a.xyz", "0 0 0\n0 2 0\n");
    // Half a rotation about +X: +Z of the scan is -Z of the world.
    const Cloud cloud = readText("s.conf", "bmesh a.xyz 0 0 0 0 0 0 1\nbmesh a.xyz 5 0 0 1 0 0 0\n");
    ASSERT_EQ(cloud.sensors.size(), 2u);
    EXPECT_EQ(cloud.sensor_of_point, (std::vector<std::uint32_t>{0, 0, 1, 1}));
    EXPECT_LT((cloud.sensors[0] - Vec3f(0, 1, 20)).norm(), 1e-5);
    EXPECT_LT((cloud.sensors[1] - Vec3f(5, -1, -20)).norm(), 1e-5);
}

TEST_F(ConfTest, SensorsOfSeveralInputs) {
    write("a.xyz", "0 0 0\n0 2 0\n");
    const std::string conf = write("s.conf", "bmesh a.xyz 0 0 0 0 0 0 1\n");
    const std::string plain = write("b.xyz", "1 1 1\n");
    EXPECT_EQ(readInputs({plain, conf}, {}).sensor_of_point, (std::vector<std::uint32_t>{kNoSensor, 0, 0}));
    EXPECT_EQ(readInputs({conf, plain}, {}).sensor_of_point, (std::vector<std::uint32_t>{0, 0, kNoSensor}));
}

TEST_F(ConfTest, BadFilesSayWhyAndWhere) {
    write("a.xyz", "1 0 0\n");
    write("bad.xyz", "1 0 0\n1 two 3\n");
    const std::string missing = reasonOfText("s.conf", "bmesh a.xyz 0 0 0 0 0 0 1\nbmesh gone.ply 0 0 0 0 0 0 1\n");
    EXPECT_HAS(missing, "s.conf:2: ");
    EXPECT_HAS(missing, "gone.ply: ");
    EXPECT_HAS(reasonOfText("s.conf", "bmesh bad.xyz 0 0 0 0 0 0 1\n"), "bad.xyz:2: column 2 *number");
    EXPECT_HAS(reasonOfText("s.conf", "bmesh a.xyz 0 0 0 0 0 0\n"), "s.conf:1: *7 numbers");
    EXPECT_HAS(reasonOfText("s.conf", "bmesh a.xyz 0 0 0 0 0 0 0\n"), "s.conf:1: *quaternion");
    EXPECT_HAS(reasonOfText("s.conf", "bmesh s.conf 0 0 0 0 0 0 1\n"), "scan of another");
    EXPECT_HAS(reasonOfText("s.conf", "camera 0 0 0 0 0 0 1\n"), "no bmesh");
}

TEST_F(ConfTest, ScansLieInTheFolderOfTheConf) {
    std::filesystem::create_directories(folder / "set/below");
    write("secret.txt", "correct horse battery staple\n");
    write("set/below/a.xyz", "1 0 0\n");
    const auto named = [&](const std::string& name) {
        return write("set/s.conf", "bmesh " + name + " 0 0 0 0 0 0 1\n");
    };
    EXPECT_EQ(read(named("below/a.xyz")).positions.size(), 1u);
    EXPECT_EQ(read(named("./below/../below/a.xyz")).positions.size(), 1u);
    EXPECT_EQ(read(named((folder / "set/below/a.xyz").string())).positions.size(), 1u);
    std::filesystem::create_symlink("below/a.xyz", folder / "set/link.xyz");
    EXPECT_EQ(read(named("link.xyz")).positions.size(), 1u);
    std::filesystem::create_symlink("../secret.txt", folder / "set/out.xyz");
    std::filesystem::create_directory_symlink("..", folder / "set/up");
    for (const std::string& name :
         {std::string("../secret.txt"), (folder / "secret.txt").string(), std::string("out.xyz"),
          std::string("up/secret.txt"), std::string("below/../../no"), std::string("/etc/no/such/file")}) {
        const std::string reason = reasonOf(named(name));
        EXPECT_HAS(reason, "s.conf:1: '");
        EXPECT_HAS(reason, "outside");
        EXPECT_EQ(reason.find("horse"), std::string::npos) << reason;
    }
    EXPECT_EQ(last_code, ExitCode::kBadInput);
}

TEST_F(ConfTest, AFileCanBeNamedAFewTimesOnly) {
    write("a.xyz", "1 0 0\n");
    std::filesystem::create_hard_link(folder / "a.xyz", folder / "b.xyz");
    std::filesystem::create_symlink("a.xyz", folder / "c.xyz");
    std::string lines;
    for (int i = 0; i < 8; ++i) lines += fmt::format("bmesh {}.xyz {} 0 0 0 0 0 1\n", "abc"[i % 3], i);
    EXPECT_EQ(readText("s.conf", lines).positions.size(), 8u);
    EXPECT_HAS(reasonOfText("s.conf", lines + "bmesh ./a.xyz 9 0 0 0 0 0 1\n"), "s.conf:9: './a.xyz': *8 times");
}

TEST_F(ConfTest, PipesAndDevicesAreRefused) {
    ASSERT_EQ(::mkfifo((folder / "pipe.xyz").c_str(), 0600), 0);
    EXPECT_HAS(reasonOfText("s.conf", "bmesh pipe.xyz 0 0 0 0 0 0 1\n"), "pipe.xyz: *regular");
    EXPECT_HAS(reasonOfText("s.conf", "bmesh - 0 0 0 0 0 0 1\n"), "s.conf:1: ");
    EXPECT_HAS(reasonOfText("s.conf", "bmesh . 0 0 0 0 0 0 1\n"), "directory");
}

TEST_F(ConfTest, EveryPrefixIsReadOrRefused) {
    write("a.xyz", "1 0 0\n");
    readPrefixes("s.conf", "camera 0 0 0 0 0 0 1\nbmesh a.xyz 0.5 0 0 0 0 0 1\nbmesh a.xyz 0 0 0 0 0 0 1\n");
}

} // namespace
} // namespace pointrt
