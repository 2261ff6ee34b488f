// SPDX-License-Identifier: Apache-2.0
// pointrt-rays cast end to end: all inputs and outputs.
#include <cmath>
#include <limits>

#include "tests/runtime/rays/cast_command.h"

namespace pointrt::test {
namespace {

constexpr double kHeight = 100 + 128 * (0.5 + 0.5 * 0x1p-21); // of the plane, at the stored precision
constexpr double kInfinity = std::numeric_limits<double>::infinity();

TEST_F(CastCommand, AnArrayBecomesArrays) {
    folder.write("rays.npy", rayArray(kTwoRays));
    const Outcome result = cast("--rays rays.npy -o out.npz -q");
    ASSERT_EQ(result.code, 0) << result.err;
    EXPECT_EQ(result.out + result.err, "");
    const auto members = zipMembers(text("out.npz"));
    const auto header = [&](const std::string& name) { return readArray(members.at(name + ".npy")).header; };
    EXPECT_EQ(members.size(), 5u);
    EXPECT_EQ(header("t_hit"), "{'descr': '<f8', 'fortran_order': False, 'shape': (2,), }");
    EXPECT_EQ(header("splat_ids"), "{'descr': '<u4', 'fortran_order': False, 'shape': (2,), }");
    EXPECT_EQ(header("instance_ids"), "{'descr': '<u4', 'fortran_order': False, 'shape': (2,), }");
    EXPECT_EQ(header("normals"), "{'descr': '<f4', 'fortran_order': False, 'shape': (2, 3), }");
    EXPECT_EQ(header("positions"), "{'descr': '<f8', 'fortran_order': False, 'shape': (2, 3), }");
    const std::vector<double> t = readArray(members.at("t_hit.npy")).as<double>(),
                              p = readArray(members.at("positions.npy")).as<double>();
    EXPECT_NEAR(t[0], (200 - kHeight) / 2, 1e-5);
    EXPECT_EQ(t[1], kInfinity);
    EXPECT_EQ(p[0], 500064);
    EXPECT_EQ(p[1], 4500064);
    EXPECT_NEAR(p[2], kHeight, 1e-5);
    EXPECT_TRUE(std::isnan(p[3]));
    EXPECT_EQ(readArray(members.at("instance_ids.npy")).as<std::uint32_t>(),
              (std::vector<std::uint32_t>{0, 4294967295u}));
    EXPECT_LT(readArray(members.at("splat_ids.npy")).as<std::uint32_t>()[0], 400u);
    EXPECT_NEAR(readArray(members.at("normals.npy")).as<float>()[2], 1, 1e-6);
}

TEST_F(CastCommand, TextBecomesText) {
    folder.write("rays.csv",
                 "ox,oy,oz,dx,dy,dz\n# a comment\n\n500064,4500064,200,0,0,-2\r\n500064 4500064 +200 0;0\t1");
    ASSERT_EQ(cast("--rays rays.csv -o out.csv").code, 0);
    const std::string lines = text("out.csv");
    EXPECT_TRUE(lines.starts_with("t_hit,splat_id,instance_id,nx,ny,nz,x,y,z\n1")) << lines;
    EXPECT_NE(lines.find(",500064,4500064,164.0000"), std::string::npos) << lines;
    EXPECT_TRUE(lines.ends_with("\ninf,4294967295,4294967295,0,0,0,nan,nan,nan\n")) << lines;
    EXPECT_EQ(std::count(lines.begin(), lines.end(), '\n'), 3);
    ASSERT_EQ(cast("--rays rays.csv -o any.csv --any").code, 0);
    EXPECT_EQ(text("any.csv"), "hit\n1\n0\n");
}

TEST_F(CastCommand, HitsBecomeAPointCloud) {
    std::vector<double> rays(kTwoRays);
    rays.insert(rays.end(), kTwoRays.begin(), kTwoRays.end());
    folder.write("rays.npy", rayArray(rays));
    ASSERT_EQ(cast("--rays rays.npy -o out.ply").code, 0);
    const std::string header = "ply\nformat binary_little_endian 1.0\ncomment ....................\n"
                               "element vertex 2\nproperty double x\nproperty double y\nproperty double z\n"
                               "property double t_hit\nproperty uint splat_id\nproperty uint instance_id\n"
                               "property float nx\nproperty float ny\nproperty float nz\nproperty uint ray\n"
                               "end_header\n";
    const std::string cloud = text("out.ply");
    ASSERT_EQ(cloud.substr(0, header.size()), header);
    constexpr std::size_t kRow = 8 + 4 + 4 + 12 + 24 + 4;
    ASSERT_EQ(cloud.size(), header.size() + 2 * kRow);
    EXPECT_NEAR(wordAt<double>(cloud, header.size() + kRow + 16), kHeight, 1e-5);
    EXPECT_EQ(wordAt<std::uint32_t>(cloud, header.size() + kRow - 4), 0u);
    EXPECT_EQ(wordAt<std::uint32_t>(cloud, header.size() + 2 * kRow - 4), 2u);
}

TEST_F(CastCommand, StandardStreamsWork) {
    folder.write("rays.npy", rayArray(kTwoRays));
    const Outcome records = cast("--rays - -o - <rays.npy");
    ASSERT_EQ(records.code, 0) << records.err;
    const ReadArray hits = readArray(records.out);
    EXPECT_EQ(hits.header, "{'descr': [('t_hit', '<f8'), ('splat_ids', '<u4'), ('instance_ids', '<u4'), "
                           "('normals', '<f4', (3,)), ('positions', '<f8', (3,))], 'fortran_order': False, "
                           "'shape': (2,), }");
    ASSERT_EQ(hits.data.size(), 2u * 52);
    EXPECT_EQ(wordAt<double>(hits.data, 52), kInfinity);
    EXPECT_NEAR(wordAt<double>(hits.data, 44), kHeight, 1e-5);
    const ReadArray any = readArray(cast("--rays - -o - --any <rays.npy").out);
    EXPECT_EQ(any.header, "{'descr': '|b1', 'fortran_order': False, 'shape': (2,), }");
    EXPECT_EQ(any.data, std::string("\x01\x00", 2));
    EXPECT_EQ(run("echo 500064 4500064 200 0 0 -2 | " POINTRT_RAYS " cast plane.pro --rays - -o - --any").out,
              "hit\n1\n");
}

TEST_F(CastCommand, TextRaysGiveAnArrayOfTheirNumber) {
    folder.write("rays.csv", "500064,4500064,200,0,0,-2\n500064,4500064,200,0,0,1\n");
    ASSERT_EQ(cast("--rays rays.csv -o out.npy --any").code, 0);
    const ReadArray any = readArray(text("out.npy"));
    EXPECT_EQ(any.header, "{'descr': '|b1', 'fortran_order': False, 'shape': (2,), }");
    EXPECT_EQ(any.data, std::string("\x01\x00", 2));
}

TEST_F(CastCommand, FloatRaysWork) {
    folder.write("rays.npy", rayArray(std::vector<float>(kTwoRays.begin(), kTwoRays.end())));
    ASSERT_EQ(cast("--rays rays.npy -o out.csv").code, 0);
    EXPECT_NE(text("out.csv").find(",500064,4500064,164.0000"), std::string::npos);
}

TEST_F(CastCommand, NoRaysGiveEmptyResults) {
    folder.write("rays.npy", rayArray(std::vector<double>()));
    ASSERT_EQ(cast("--rays rays.npy -o out.npz").code, 0);
    EXPECT_EQ(readArray(zipMembers(text("out.npz")).at("positions.npy")).header,
              "{'descr': '<f8', 'fortran_order': False, 'shape': (0, 3), }");
    ASSERT_EQ(run(": >none; " POINTRT_RAYS " cast plane.pro --rays none -o out.csv --any").code, 0);
    EXPECT_EQ(text("out.csv"), "hit\n");
}

TEST_F(CastCommand, LimitsApply) {
    folder.write("rays.npy", rayArray(kTwoRays));
    ASSERT_EQ(cast("--rays rays.npy --any -o out.csv --t-max 17.9").code, 0);
    EXPECT_EQ(text("out.csv"), "hit\n0\n0\n");
    ASSERT_EQ(cast("--rays rays.npy --any -o out.csv --t-max 18.1").code, 0);
    EXPECT_EQ(text("out.csv"), "hit\n1\n0\n");
    ASSERT_EQ(cast("--rays rays.npy --any -o out.csv --t-min 18.1").code, 0);
    EXPECT_EQ(text("out.csv"), "hit\n0\n0\n");
}

TEST_F(CastCommand, SeveralScansAreNumbered) {
    writeScan(folder.file("over.pro"), planeSplats(20, 0.75f), {});
    folder.write("rays.csv", "500064 4500064 300 0 0 -1\n500064 4500064 100 0 0 1\n");
    ASSERT_EQ(run(POINTRT_RAYS " cast plane.pro over.pro --rays rays.csv -o out.npz").code, 0);
    EXPECT_EQ(readArray(zipMembers(text("out.npz")).at("instance_ids.npy")).as<std::uint32_t>(),
              (std::vector<std::uint32_t>{1, 0}));
}

TEST_F(CastCommand, AttributesAreWritten) {
    folder.write("rays.csv", "10.5 20.75 31 0 0 -1\n0 0 0 1 0 0\n"); // splat 0 of the tiny scene, and a miss
    const std::string words = POINTRT_RAYS " cast " POINTRT_GOLDEN_DIR "/tiny_compact_scan.pro --rays rays.csv ";
    ASSERT_EQ(run(words + "-o out.npz --attributes classification,rgb16,gps_time").code, 0);
    const auto members = zipMembers(text("out.npz"));
    EXPECT_EQ(readArray(members.at("classification.npy")).as<std::uint8_t>(), (std::vector<std::uint8_t>{2, 0}));
    EXPECT_EQ(readArray(members.at("rgb16.npy")).header, "{'descr': '<u2', 'fortran_order': False, 'shape': (2, 3), }");
    EXPECT_EQ(readArray(members.at("rgb16.npy")).as<std::uint16_t>()[2], 3);
    EXPECT_EQ(readArray(members.at("gps_time.npy")).as<double>()[0], 1e9 + 0.25);
    EXPECT_TRUE(std::isnan(readArray(members.at("gps_time.npy")).as<double>()[1]));
    ASSERT_EQ(run(words + "-o out.csv --attributes rgb16").code, 0);
    EXPECT_NE(text("out.csv").find("x,y,z,rgb16_0,rgb16_1,rgb16_2\n"), std::string::npos);
    ASSERT_EQ(run(words + "-o out.ply --attributes rgb16,classification").code, 0);
    EXPECT_NE(text("out.ply").find("property ushort rgb16_2\nproperty uchar classification\nproperty uint ray\n"),
              std::string::npos);
}

TEST_F(CastCommand, MemoryDoesNotGrowWithTheRays) {
#ifdef __SANITIZE_ADDRESS__
    GTEST_SKIP() << "AddressSanitizer keeps what is freed";
#endif
    const std::string one = rayArray(std::vector<float>(6 * 100000, 1.0f)), row = one.substr(one.size() - 6 * 400000);
    const auto peak = [&](int times) {
        std::ofstream rays(folder.file("many.npy"), std::ios::binary);
        rays << arrayBytes("{'descr': '<f4', 'fortran_order': False, 'shape': (" + std::to_string(times * 100000) +
                               ", 6), }",
                           row.data(), 0);
        for (int i = 0; i < times; ++i) rays << row;
        rays.close();
        const Outcome result = cast("--rays many.npy -o out.npz --stats stats.json");
        EXPECT_EQ(result.code, 0) << result.err;
        const std::string report = text("stats.json");
        return std::stod(report.substr(report.find("\"peak_rss_bytes\": ") + 18));
    };
    const double few = peak(22), many = peak(66); // two and six full blocks plus a partial one
    EXPECT_LT(many, few + 16e6) << "44 million numbers more are 106 MB";
}

TEST_F(CastCommand, ReportsHaveCountsAndTimes) {
    folder.write("rays.npy", rayArray(kTwoRays));
    const Outcome result = cast("--rays rays.npy -o out.npz --stats - -v");
    ASSERT_EQ(result.code, 0);
    for (const char* key : {"\"device\": \"", "\"splats\": 400,", "\"rays\": 2,", "\"hits\": 1,",
                            "\"mrays_per_second\": ", "\"seconds\": {", "\"open\": ", "\"read\": ", "\"cast\": ",
                            "\"write\": ", "\"total\": ", "\"peak_rss_bytes\": "})
        EXPECT_NE(result.out.find(key), std::string::npos) << key;
    EXPECT_NE(result.err.find("2 rays, 1 hits; "), std::string::npos) << result.err;
}

TEST_F(CastCommand, HelpAndVersionArePrinted) {
    for (const char* words : {"--help", "cast --help", "--version", "cast --version"}) {
        const Outcome result = run(std::string(POINTRT_RAYS " ") + words);
        EXPECT_EQ(result.code, 0) << words;
        EXPECT_NE(result.out.find("pointrt-rays"), std::string::npos) << words;
        EXPECT_EQ(result.err, "") << words;
    }
}

} // namespace
} // namespace pointrt::test
