// SPDX-License-Identifier: Apache-2.0
// Scans that were misread without a word: missing data, hidden degrees, black files, mixed units, mirrors.
#include "tests/preprocess/input/input_fixture.h"
#include "tests/support/las_file.h"

#include "preprocess/ingest/no_data.h"
#include "preprocess/input/scan_checks.h"

namespace pointrt {
namespace {

struct MisreadTest : InputTest {
    /// 20 x 20 points a metre apart around (x, y), 350 to 357 high; `marked(i)` replaces some.
    static std::string terrain(const std::function<std::string(int)>& marked, double x = 512345, double y = 5403210) {
        std::string text;
        for (int i = 0; i < 400; ++i) {
            const std::string other = marked(i);
            text += other.empty() ? fmt::format("{} {} {}\n", x + i % 20, y + i / 20, 350 + 0.5 * (i % 15)) : other;
        }
        return text;
    }
    static std::string plyOf(double scale, const std::string& color = "") {
        std::string text = "ply\nformat ascii 1.0\nelement vertex 400\nproperty float x\nproperty float y\nproperty "
                           "float z\n";
        if (!color.empty()) text += "property uchar red\nproperty uchar green\nproperty uchar blue\n";
        text += "end_header\n";
        for (int i = 0; i < 400; ++i)
            text += fmt::format("{} {} {} {}\n", scale * (i % 20), scale * (i / 20), scale * (i % 3), color);
        return text;
    }
};

TEST_F(MisreadTest, CustomaryNoDataIsLeftOut) {
    for (const std::string value :
         {"-9999", "-9999.0", "-32768", "-99999", "9999", "-3.4e10", "1e10", "-999", "99999.99"}) {
        const Cloud cloud =
            readText("a.xyz", terrain([&](int i) {
                         return i % 10 == 0 ? fmt::format("{} {} {}\n", 512345 + i % 20, 5403210 + i / 20, value)
                                            : std::string();
                     }));
        const bool customary = value != "-3.4e10"; // far away, but not a customary value: reported
        EXPECT_EQ(cloud.positions.size(), customary ? 360u : 400u) << value;
        EXPECT_EQ(cloud.points_no_data, customary ? 40u : 0u) << value;
        EXPECT_EQ(cloud.points_read, 400u);
        EXPECT_HAS(notesOf(cloud), customary ? "a.xyz: *z = *left out" : "40 points with z = *--bounds") << value;
    }
}

TEST_F(MisreadTest, PointsAtZeroFarFromTheOthersAreLeftOut) {
    const auto marked = [](int i) { return i % 50 == 7 ? "0 0 0\n" : ""; };
    const Cloud cloud = readText("a.xyz", terrain(marked));
    EXPECT_EQ(cloud.positions.size(), 392u);
    EXPECT_EQ(cloud.points_no_data, 8u);
    const auto place = [](int i) { return i % 50 == 7 ? "0 0 352\n" : ""; };
    EXPECT_EQ(readText("b.xyz", terrain(place, -10, -10)).points_no_data, 0u);
}

TEST_F(MisreadTest, PulsesWithoutAReturnTellWhereTheScannerIs) {
    const auto frame = [&](int none, int points) {
        std::string text;
        for (int i = 0; i < points; ++i)
            text += i < none ? "0 0 0\n" : fmt::format("{} {} {}\n", i % 23 - 9.5, i % 17 - 7.5, i % 5 - 1.5);
        return text;
    };
    const Cloud cloud = readText("a.xyz", frame(20, 400));
    EXPECT_EQ(cloud.positions.size(), 380u);
    EXPECT_EQ(cloud.points_no_data, 20u);
    ASSERT_TRUE(cloud.scans[0].sensor.has_value());
    EXPECT_EQ(*cloud.scans[0].sensor, Vec3d(0, 0, 0));
    EXPECT_EQ(cloud.sensor_of_point, std::vector<std::uint32_t>(380, 0));
    EXPECT_HAS(notesOf(cloud), "a.xyz: *20 points with x = y = z = 0*left out*scanner");

    ReadOptions options;
    options.transform = Eigen::Affine3d(Eigen::Translation3d(512345.25, 5403210.5, 30));
    const Cloud moved = read(write("b.xyz", frame(20, 400)), options);
    EXPECT_EQ(moved.positions.size(), 380u);
    ASSERT_TRUE(moved.scans[0].sensor.has_value());
    EXPECT_EQ(*moved.scans[0].sensor, Vec3d(512345.25, 5403210.5, 30));
}

TEST_F(MisreadTest, FewPointsAtTheOriginAreASurface) {
    const auto grid = [&](int zeros, int points) {
        std::string text;
        for (int i = 0; i < points; ++i)
            text += i < zeros ? "0 0 0\n" : fmt::format("{} {} {}\n", i % 50 - 25, i / 50, i % 3);
        return text;
    };
    for (const auto& [zeros, points] : {std::pair(15, 400), std::pair(20, 2500)}) {
        const Cloud cloud = readText("a.xyz", grid(zeros, points));
        EXPECT_EQ(cloud.points_no_data, 0u) << zeros;
        EXPECT_FALSE(cloud.scans[0].sensor.has_value()) << zeros;
    }
}

TEST_F(MisreadTest, HeightsOfZeroFarBelowTheOthersAreLeftOut) {
    const auto marked = [](int i) {
        return i % 10 == 0 ? fmt::format("{} {} 0\n", 512345 + i % 20, 5403210 + i / 20) : std::string();
    };
    const Cloud cloud = readText("a.xyz", terrain(marked));
    EXPECT_EQ(cloud.points_no_data, 40u);
    EXPECT_HAS(notesOf(cloud), "z = 0, *left out");
    const auto half = [&](int i) { return i % 2 == 0 ? marked(i / 20 * 20) : std::string(); }; // a floor
    EXPECT_EQ(readText("b.xyz", terrain(half)).points_no_data, 0u);
}

TEST_F(MisreadTest, DataStays) {
    const auto kept = [&](const std::string& text) {
        const Cloud cloud = readText("a.xyz", text);
        EXPECT_EQ(cloud.points_no_data, 0u);
        return notesOf(cloud);
    };
    std::string planes, pits;
    for (int i = 0; i < 400; ++i) {
        planes += fmt::format("{} {} {}\n", i % 20, i / 20, i < 200 ? 0 : 100 + i % 2);
        pits += fmt::format("{} {} {}\n", i % 20, i / 20, -9999 - 40 * (i % 300)); // in millimetres
    }
    EXPECT_EQ(kept(planes), "");
    EXPECT_EQ(kept(pits), "");
    EXPECT_EQ(kept(terrain([](int i) { return i == 3 ? "512345 5403210 -9999\n" : ""; })), ""); // a single stray
}

TEST_F(MisreadTest, NoDataIsFoundUnderATransform) {
    const std::string path = write("a.xyz", terrain([](int i) { return i % 10 == 0 ? "512350 5403215 -9999\n" : ""; }));
    ReadOptions options;
    options.transform = Eigen::Affine3d(Eigen::AngleAxisd(0.5, Vec3d(1, 2, 3).normalized()));
    EXPECT_EQ(read(path, options).positions.size(), 360u);
}

TEST_F(MisreadTest, DegreesWithoutACoordinateSystemAreConverted) {
    test::LasParts parts;
    parts.scale = 1e-7;
    std::string text;
    for (int i = 0; i < 400; ++i) {
        const int x = -909708000 + 450 * (i % 20), y = 302500000 + 450 * (i / 20);
        parts.points.push_back(test::lasPoint(20, x, y, 0, 0));
        text += fmt::format("{:.7f} {:.7f} {}\n", x * 1e-7, y * 1e-7, i % 13);
    }
    ReadOptions options;
    options.scales_degrees = true;
    const Cloud cloud = read(write("a.xyz", text), options);
    EXPECT_HAS(notesOf(cloud), "a.xyz: *no coordinate system*degrees");
    Eigen::AlignedBox3d box;
    for (std::size_t i = 0; i < 400; ++i) box.extend(world(cloud, i));
    // 19 steps of 0.000045 degrees at 30.25 degrees north: 96.2 km and 110.9 km a degree
    EXPECT_NEAR(box.sizes().x(), 82.3, 0.1);
    EXPECT_NEAR(box.sizes().y(), 94.8, 0.1);
    EXPECT_HAS(notesOf(read(write("b.xyz", text))), "b.xyz: *no coordinate system*degrees");
}

TEST_F(MisreadTest, LengthsAreNotDegrees) {
    using Box = Eigen::AlignedBox3d;
    EXPECT_TRUE(looksLikeDegrees(Box(Vec3d(7, 45, 100), Vec3d(7.01, 45.01, 112))));
    EXPECT_FALSE(looksLikeDegrees(Box(Vec3d(7, 45, 100), Vec3d(7.5, 45.5, 112))));    // a tall room far away
    EXPECT_FALSE(looksLikeDegrees(Box(Vec3d(30, 20, 0), Vec3d(30.3, 20.3, 10))));     // a mast
    EXPECT_FALSE(looksLikeDegrees(Box(Vec3d(0, 0, 0), Vec3d(0.01, 0.01, 5))));        // a wire at the origin
    EXPECT_FALSE(looksLikeDegrees(Box(Vec3d(500, 45, 100), Vec3d(500.01, 45, 112)))); // beyond 360
    EXPECT_FALSE(looksLikeDegrees(Box()));
}

TEST_F(MisreadTest, BlackFilesHaveNoColors) {
    test::LasParts black;
    black.format = 2;
    for (int i = 0; i < 9; ++i) {
        std::string point = test::lasPoint(26, i % 3 * 100, i / 3 * 100, 0, 0);
        std::fill(point.begin() + 12, point.end(), '\0');
        black.points.push_back(point);
    }
    test::LasParts grey = black;
    for (std::string& point : grey.points) test::put(point, 20, std::uint16_t{0x4000});
    const std::string a = write("a.las", black.bytes()), b = write("b.las", black.bytes());
    const std::string c = write("c.las", grey.bytes()), d = write("d.ply", plyOf(1, "0 0 0"));
    EXPECT_TRUE(readInputs({a, b}, {}).colors.empty());
    EXPECT_TRUE(readInputs({a, d, b}, {}).colors.empty());
    for (const auto& files : {std::vector{a, c, d}, std::vector{d, a, c}, std::vector{c, a, d}}) {
        const Cloud cloud = readInputs(files, {});
        ASSERT_EQ(cloud.colors.size(), 418u);
        const auto count = [&](const Rgb8& color) {
            return std::count(cloud.colors.begin(), cloud.colors.end(), color);
        };
        EXPECT_EQ(count({200, 200, 200}), 409);
        EXPECT_EQ(count({0x40, 0, 0}), 9);
        EXPECT_HAS(notesOf(cloud), "black");
    }
}

TEST_F(MisreadTest, MillimetresBesideMetresAreNoted) {
    const std::string m = write("m.ply", plyOf(1)), mm = write("mm.ply", plyOf(1000)),
                      half = write("h.ply", plyOf(0.5));
    EXPECT_HAS(notesOf(readInputs({m, mm}, {})), "mm.ply: is 1000 times *m.ply");
    EXPECT_HAS(notesOf(readInputs({mm, m}, {})), "mm.ply: is 1000 times *m.ply");
    EXPECT_EQ(notesOf(readInputs({m, half}, {})), "");
    EXPECT_EQ(notesOf(readInputs({m, write("cm.ply", plyOf(100))}, {})), "");
}

TEST_F(MisreadTest, UnitsThatDifferAreNoted) {
    const auto las = [&](const std::string& name, const char* unit) {
        test::LasParts parts;
        parts.records = {test::lasRecord("LASF_Projection", 2112, fmt::format("PROJCS[\"p\",UNIT[\"u\",{}]]", unit))};
        for (int i = 0; i < 9; ++i) parts.points.push_back(test::lasPoint(20, i % 3, i / 3, i, 0));
        return write(name, parts.bytes());
    };
    EXPECT_HAS(notesOf(readInputs({las("a.las", "1"), las("b.las", "0.3048")}, {})), "b.las: *unit");
    EXPECT_EQ(notesOf(readInputs({las("a.las", "1"), las("c.las", "1")}, {})), "");
}

TEST_F(MisreadTest, MirrorsKeepFacesOutwards) {
    const std::string path =
        write("a.off", "OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n");
    for (const double mirror : {1.0, -1.0}) {
        ReadOptions options;
        options.transform = Eigen::Affine3d(Eigen::Scaling(mirror, 1.0, 1.0));
        options.sample_count = 1000;
        const Cloud cloud = read(path, options);
        const Vec3d middle(mirror / 4, 0.25, 0.25);
        for (std::size_t i = 0; i < cloud.positions.size(); ++i)
            ASSERT_GT((world(cloud, i) - middle).dot(cloud.normals[i].cast<double>()), 0) << mirror;
    }
}

TEST_F(MisreadTest, WithheldPointsAreLeftOut) {
    for (const std::uint8_t format : {std::uint8_t{0}, std::uint8_t{6}}) {
        test::LasParts parts;
        parts.format = format;
        parts.minor = format == 0 ? 2 : 4;
        for (int i = 0; i < 8; ++i) {
            std::string point = test::lasPoint(format == 0 ? 20 : 30, i, i, i, 0);
            point[15] = i % 4 == 1 ? static_cast<char>(format == 0 ? 0x80 : 0x04) : '\0';
            parts.points.push_back(point);
        }
        const std::string path = write("a.las", parts.bytes());
        ReadOptions options;
        EXPECT_EQ(read(path, options).positions.size(), 8u);
        options.drops_withheld = true;
        const Cloud cloud = read(path, options);
        EXPECT_EQ(cloud.positions.size(), 6u);
        EXPECT_EQ(cloud.points_withheld, 2u);
        EXPECT_EQ(cloud.points_filtered, 0u);
        EXPECT_HAS(notesOf(cloud), "a.las: *withheld*--keep-withheld");
        for (std::string& point : parts.points) point[15] = static_cast<char>(format == 0 ? 0x80 : 0x04);
        EXPECT_HAS(reasonOf(write("b.las", parts.bytes()), options), "b.las: all of its 8 *--keep-withheld");
    }
}

} // namespace
} // namespace pointrt
