// SPDX-License-Identifier: Apache-2.0
#include "tests/preprocess/input/input_fixture.h"

#include <algorithm>

namespace pointrt {
namespace {

using SampleTest = InputTest;

/// A unit cube of quads around the origin, corners 0 to 7 counted in binary x, y, z.
const std::string kCube = "OFF\n8 6 0\n-1 -1 -1\n-1 -1 1\n-1 1 -1\n-1 1 1\n1 -1 -1\n1 -1 1\n1 1 -1\n1 1 1\n"
                          "4 0 1 3 2\n4 4 6 7 5\n4 0 4 5 1\n4 2 3 7 6\n4 0 2 6 4\n4 1 5 7 3\n";

TEST_F(SampleTest, ASpreadCubeKeepsItsSidesAndEdges) {
    const Cloud cloud = read(write("c.off", kCube), {.format = "", .sample_count = 6000, .seed = 5});
    ASSERT_EQ(cloud.positions.size(), 6000u);
    ASSERT_EQ(cloud.normals.size(), 6000u);
    EXPECT_TRUE(cloud.triangles.empty());
    int on_side[3][2] = {};
    for (std::size_t i = 0; i < cloud.positions.size(); ++i) {
        const Vec3d p = world(cloud, i);
        int axis = 0;
        EXPECT_NEAR(p.cwiseAbs().maxCoeff(&axis), 1, 1e-6);
        ++on_side[axis][p[axis] > 0];
        // Corner normals of a cube lie 55 degrees from its sides: too far to be used.
        EXPECT_NEAR(cloud.normals[i][axis], p[axis] > 0 ? 1 : -1, 1e-6);
    }
    for (const auto& axis : on_side)
        for (const int count : axis) EXPECT_NEAR(count, 1000, 3);
}

TEST_F(SampleTest, TheSameSeedGivesTheSamePoints) {
    const std::string path = write("c.off", kCube);
    const auto sampled = [&](std::uint64_t seed) {
        return read(path, {.format = "", .sample_count = 100, .seed = seed}).positions;
    };
    EXPECT_EQ(sampled(1), sampled(1));
    EXPECT_NE(sampled(1), sampled(2));
}

TEST_F(SampleTest, PointsSpreadMoreEvenlyThanWhiteNoise) {
    // A square of two triangles; in each of 20 x 20 cells 10 points are due. White noise has a variance of 10.
    const std::string square = "OFF\n4 1 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n";
    const Cloud cloud = read(write("s.off", square), {.format = "", .sample_count = 4000, .seed = 3});
    std::vector<int> cells(400);
    for (std::size_t i = 0; i < cloud.positions.size(); ++i) {
        const Vec3d p = world(cloud, i) * 20;
        ++cells[std::min(19, static_cast<int>(p[1])) * 20 + std::min(19, static_cast<int>(p[0]))];
    }
    double variance = 0;
    for (const int count : cells) variance += (count - 10.0) * (count - 10.0) / 400;
    EXPECT_LT(variance, 3);
}

TEST_F(SampleTest, SmoothNormalsAndColorsAreInterpolated) {
    const std::string text =
        "v 0 0 0 1 0 0\nv 1 0 0 0 1 0\nv 0 1 0 0 0 1\nvn 0.2 0 1\nvn -0.2 0 1\nvn 0 0.2 1\nf 1//1 2//2 3//3\n";
    const Cloud cloud = read(write("a.obj", text), {.format = "", .sample_count = 50, .seed = 0});
    for (std::size_t i = 0; i < cloud.positions.size(); ++i) {
        const Vec3d p = world(cloud, i);
        EXPECT_NEAR(cloud.colors[i][1], 255 * p[0], 1.01);
        EXPECT_NEAR(cloud.colors[i][2], 255 * p[1], 1.01);
        EXPECT_NEAR(cloud.normals[i].norm(), 1, 1e-6);
        EXPECT_NEAR(cloud.normals[i][0] / cloud.normals[i][2], 0.2 * (1 - p[0] - p[1]) - 0.2 * p[0], 2e-2);
    }
}

TEST_F(SampleTest, NormalsAgainstTheWindingStay) {
    const std::string text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 -1\nf 1//1 2//1 3//1\n";
    for (const Vec3f& normal : read(write("a.obj", text), {.format = "", .sample_count = 5}).normals)
        EXPECT_EQ(normal, Vec3f(0, 0, -1));
}

std::string countedNotesOf(const Cloud& cloud) {
    std::string all;
    for (const Note& note : cloud.notes)
        all += note.file + " +" + std::to_string(note.more_files) + ": " + note.text + "\n";
    return all;
}

/// The vertices of kCube, two more that no face uses, and the faces.
const std::string kCubeAndMore = "OFF\n10 6 0\n0 0 0\n" + kCube.substr(10, kCube.find("4 0") - 10) + "0.5 0 0\n" +
                                 "4 1 2 4 3\n4 5 7 8 6\n4 1 5 6 2\n4 3 4 8 7\n4 1 3 7 5\n4 2 6 8 4\n";

TEST_F(SampleTest, VerticesThatNoFaceUsesAreLeftOut) {
    const Cloud plain = read(write("c.off", kCube)), cloud = read(write("d.off", kCubeAndMore));
    EXPECT_EQ(cloud.points_read, 10u);
    EXPECT_EQ(cloud.points_unused, 2u);
    ASSERT_EQ(cloud.positions.size(), 8u);
    EXPECT_EQ(cloud.triangles, plain.triangles);
    for (std::size_t i = 0; i < 8; ++i) {
        EXPECT_EQ(world(cloud, i), world(plain, i));
        EXPECT_EQ(cloud.normals[i], plain.normals[i]);
    }
    const Cloud sampled = read(write("d.off", kCubeAndMore), {.format = "", .sample_count = 100});
    EXPECT_EQ(sampled.positions.size(), 100u);
    EXPECT_EQ(sampled.points_unused, 2u);
}

TEST_F(SampleTest, PointsOfOtherFilesAndOfBrokenFacesStay) {
    const std::string points = write("a.xyz", "7 7 7\n8 8 8\n"), mesh = write("d.off", kCubeAndMore);
    const Cloud cloud = readInputs({points, mesh, points}, {});
    ASSERT_EQ(cloud.positions.size(), 12u);
    EXPECT_EQ(world(cloud, 1), Vec3d(8, 8, 8));
    EXPECT_EQ(world(cloud, 10), Vec3d(7, 7, 7));
    const Cloud broken = readText("b.obj", "v 0 0 0\nv 1 0 0\nv nan 1 0\nv 0 1 0\nv 1 1 0\nf 1 2 3\nf 1 2 4\n");
    EXPECT_EQ(broken.positions.size(), 3u);
    const Cloud bereft = readText("b.obj", "v 0 0 0\nv 1 0 0\nv nan 1 0\nv 5 5 5\nv 0 1 0\nf 1 4 3\nf 1 2 5\n");
    EXPECT_EQ(bereft.positions.size(), 4u);
    EXPECT_EQ(bereft.points_unused, 0u);
}

TEST_F(SampleTest, ACloudWithSomeFacesKeepsItsPoints) {
    std::string text;
    for (int i = 0; i < 40; ++i) text += fmt::format("v {} {} 0\n", i % 7, i / 7);
    const Cloud cloud = readText("a.obj", text + "f 1 2 8\n");
    EXPECT_EQ(cloud.positions.size(), 40u);
    EXPECT_EQ(cloud.points_unused, 0u);
    EXPECT_HAS(countedNotesOf(cloud), "a.obj +0: its faces use 3 of 40 points only; the others stay");
}

TEST_F(SampleTest, CoarseMeshesAreTold) {
    const std::string cube = write("c.off", kCube), again = write("d.off", kCube);
    const std::string notes = countedNotesOf(readInputs({cube, again}, {}));
    EXPECT_HAS(notes, "c.off +1: its faces are large");
    EXPECT_HAS(notes, "--sample N");
    EXPECT_EQ(notes.find('\n'), notes.size() - 1);
    EXPECT_EQ(countedNotesOf(readInputs({cube}, {.format = "", .sample_count = 10})), "");
    // A square of n x n cells: edges of sqrt(2) / n, a diagonal of sqrt(2). At 20 cells a side they are a twentieth.
    for (const int n : {19, 21}) {
        std::string grid;
        for (int i = 0; i <= n; ++i)
            for (int k = 0; k <= n; ++k) grid += fmt::format("v {} {} 0\n", i, k);
        for (int i = 0; i < n; ++i)
            for (int k = 1; k <= n; ++k)
                grid += fmt::format("f {} {} {} {}\n", i * (n + 1) + k, i * (n + 1) + k + 1, (i + 1) * (n + 1) + k + 1,
                                    (i + 1) * (n + 1) + k);
        EXPECT_EQ(countedNotesOf(readText("g.obj", grid)).empty(), n == 21) << n;
    }
}

TEST_F(SampleTest, PlainPointsStay) {
    const std::string points = write("a.xyz", "7 7 7\n"), mesh = write("c.off", kCube);
    const Cloud cloud = readInputs({mesh, points}, {.format = "", .sample_count = 10});
    EXPECT_EQ(cloud.positions.size(), 11u);
    EXPECT_EQ(world(cloud, 0), Vec3d(7, 7, 7));
    EXPECT_EQ(cloud.points_read, 9u);
}

TEST_F(SampleTest, BadRequestsSayWhy) {
    EXPECT_HAS(reasonOf(write("a.xyz", "1 2 3\n"), {.format = "", .sample_count = 10}),
               "a.xyz: has no faces to sample");
    EXPECT_EQ(last_code, ExitCode::kBadUsage);
    EXPECT_HAS(reasonOf(write("a.off", kCube), {.format = "", .sample_count = 1ull << 40}), "1099511627776 samples");
    EXPECT_EQ(last_code, ExitCode::kBadUsage);
    EXPECT_HAS(reasonOf(write("b.obj", "v 0 0 0\nf 1 1 1\n"), {.format = "", .sample_count = 10}), "no area");
}

TEST_F(SampleTest, VertexNormalsDoNotDependOnTheTriangulation) {
    const Cloud cloud = read(write("c.off", kCube));
    for (std::size_t i = 0; i < 8; ++i)
        EXPECT_LT((cloud.normals[i].cast<double>() - world(cloud, i).normalized()).norm(), 1e-6);
    // Two sides at a right angle, one large and one small: the edge between them leans halfway.
    const std::string roof = "OFF\n4 2 0\n0 0 0\n0 1 0\n3 0 0\n0 0 1\n3 0 2 1\n3 0 3 1\n";
    EXPECT_LT((read(write("r.off", roof)).normals[0] - Vec3f(-1, 0, 1).normalized()).norm(), 1e-6);
}

} // namespace
} // namespace pointrt
