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
        // Corner normals of a cube deviate 55 degrees from its sides: too much to be used.
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
    // A square of two triangles; each of 20 x 20 cells should have 10 points. White noise has a variance of 10.
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

TEST_F(SampleTest, UnusedVerticesAreDropped) {
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

TEST_F(SampleTest, PointsOfOtherFilesAndOfRemovedFacesStay) {
    const std::string points = write("a.xyz", "7 7 7\n8 8 8\n"), mesh = write("d.off", kCubeAndMore);
    const Cloud cloud = readInputs({points, mesh, points}, {});
    ASSERT_EQ(cloud.positions.size(), 12u);
    EXPECT_EQ(world(cloud, 1), Vec3d(8, 8, 8));
    EXPECT_EQ(world(cloud, 10), Vec3d(7, 7, 7));
    const Cloud broken = readText("b.obj", "v 0 0 0\nv 1 0 0\nv nan 1 0\nv 0 1 0\nv 1 1 0\nf 1 2 3\nf 1 2 4\n");
    EXPECT_EQ(broken.positions.size(), 3u);
    const Cloud removed = readText("b.obj", "v 0 0 0\nv 1 0 0\nv nan 1 0\nv 5 5 5\nv 0 1 0\nf 1 4 3\nf 1 2 5\n");
    EXPECT_EQ(removed.positions.size(), 4u);
    EXPECT_EQ(removed.points_unused, 0u);
}

TEST_F(SampleTest, ACloudWithSomeFacesKeepsItsPoints) {
    std::string text;
    for (int i = 0; i < 40; ++i) text += fmt::format("v {} {} 0\n", i % 7, i / 7);
    const Cloud cloud = readText("a.obj", text + "f 1 2 8\n");
    EXPECT_EQ(cloud.positions.size(), 40u);
    EXPECT_EQ(cloud.points_unused, 0u);
    EXPECT_HAS(countedNotesOf(cloud), "a.obj +0: *3 of 40 points*kept");
}

const ReadOptions kWhereCoarse{.format = "", .sample_count = std::nullopt};

/// A square of cells x cells quads, every other row of vertices raised.
std::string sheetOf(int cells, double raised = 0) {
    std::string text;
    for (int i = 0; i <= cells; ++i)
        for (int k = 0; k <= cells; ++k) text += fmt::format("v {} {} {}\n", i, k, i % 2 * raised);
    const auto vertex = [&](int i, int k) { return i * (cells + 1) + k + 1; };
    for (int i = 0; i < cells; ++i)
        for (int k = 0; k < cells; ++k)
            text +=
                fmt::format("f {} {} {} {}\n", vertex(i, k), vertex(i, k + 1), vertex(i + 1, k + 1), vertex(i + 1, k));
    return text;
}

TEST_F(SampleTest, CoarseMeshesAreSampledByDefault) {
    const std::string cube = write("c.off", kCube), again = write("d.off", kCube);
    std::vector<FileReport> files;
    const Cloud cloud = readInputs({cube, again}, kWhereCoarse, {}, &files);
    // 630 samples to the diagonal, an area of twice 24, a diagonal of sqrt(12): more than a million
    EXPECT_EQ(cloud.positions.size(), 1'000'000u);
    EXPECT_TRUE(cloud.triangles.empty());
    ASSERT_EQ(files.size(), 2u);
    EXPECT_EQ(files[0].sampled + files[1].sampled, 1'000'000u);
    EXPECT_NEAR(double(files[0].sampled), 500'000, 1000);
    const std::string notes = countedNotesOf(cloud);
    EXPECT_HAS(notes, "c.off +1: *8 vertices *--sample N");
    EXPECT_EQ(notes.find('\n'), notes.size() - 1);
    EXPECT_EQ(read(cube, kWhereCoarse).positions.size(), 793'800u);
    const Cloud vertices = read(cube, {.format = "", .sample_count = 0});
    EXPECT_EQ(vertices.positions.size(), 8u);
    EXPECT_EQ(countedNotesOf(vertices) + countedNotesOf(read(cube, {.format = "", .sample_count = 10})), "");
}

TEST_F(SampleTest, MeshesAreCoarseByTheirEdgesOrBySlopes) {
    const auto points = [&](const std::string& text) {
        return read(write("g.obj", text), kWhereCoarse).positions.size();
    };
    // edges of sqrt(2) / n, a diagonal of sqrt(2): at 20 cells a side they are a twentieth
    EXPECT_EQ(points(sheetOf(19)), 198'450u); // 630 * 630 / 2
    EXPECT_EQ(points(sheetOf(21)), 22u * 22);
    // Pleats of 40 cells: faces at 45 degrees, edges of sqrt(3), discs level along the folds. Discs deviate by 0.8
    // sqrt(3) sin 45 = 0.98 from a diagonal of 56.6: 7 of 420 pixels. Flatter pleats do not.
    EXPECT_EQ(points(sheetOf(40, 1)), 280'563u); // 630 * 630 * 1600 * sqrt(2) / 3201
    EXPECT_EQ(points(sheetOf(40, 0.1)), 41u * 41);
}

TEST_F(SampleTest, VerticesOfEachFaceCountAsOneDisc) {
    // Pleats with separate vertices for each face, all with correct normals: only one disc remains at each position.
    const auto pleats = [](double raised) {
        std::string text;
        for (int i = 0; i < 40; ++i)
            for (int k = 0; k < 40; ++k) {
                for (const auto& [x, y] : {std::pair(i, k), {i, k + 1}, {i + 1, k + 1}, {i + 1, k}})
                    text += fmt::format("v {} {} {}\n", x, y, x % 2 * raised);
                text += "f -4 -3 -2 -1\n";
            }
        return text;
    };
    EXPECT_EQ(read(write("p.obj", pleats(1)), kWhereCoarse).positions.size(), 280'563u);
    EXPECT_EQ(read(write("p.obj", pleats(0)), kWhereCoarse).positions.size(), 6400u);
}

TEST_F(SampleTest, MeshesThatAreNotSampledAreNoted) {
    const Cloud loose = read(write("d.off", kCubeAndMore), kWhereCoarse);
    EXPECT_EQ(loose.positions.size(), 793'800u);
    EXPECT_EQ(loose.points_unused, 2u);
    std::string flat = kCube;
    flat.replace(4, 5, "8 7 0").append("3 0 1 0\n");
    EXPECT_HAS(countedNotesOf(read(write("f.off", flat), kWhereCoarse)), "sampled *1 without area");
    const Cloud no_area = read(write("n.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n"), kWhereCoarse);
    EXPECT_EQ(no_area.positions.size(), 3u);
    std::string cloud;
    for (int i = 0; i < 40; ++i) cloud += fmt::format("v {} {} 0\n", i % 7, i / 7);
    EXPECT_EQ(read(write("a.obj", cloud + "f 1 2 8\n"), kWhereCoarse).positions.size(), 40u);
}

TEST_F(SampleTest, FineMeshesAndPointsBesideCoarseOnesStay) {
    const std::string cube = write("c.off", kCube), points = write("a.xyz", "7 7 7\n8 8 8\n");
    std::string fine = sheetOf(21);
    fine += "v 9 9 9\n"; // no face uses it
    const Cloud cloud = readInputs({write("f.obj", fine), cube, points}, kWhereCoarse);
    ASSERT_EQ(cloud.positions.size(), 22u * 22 + 2 + 793'800);
    EXPECT_EQ(cloud.points_unused, 1u);
    EXPECT_EQ(world(cloud, 22 * 22 - 1), Vec3d(21, 21, 0));
    EXPECT_EQ(world(cloud, 22 * 22 + 1), Vec3d(8, 8, 8));
    int on_side[3][2] = {};
    for (std::size_t i = 22 * 22 + 2; i < cloud.positions.size(); ++i) {
        const Vec3d p = world(cloud, i);
        int axis = 0;
        ASSERT_NEAR(p.cwiseAbs().maxCoeff(&axis), 1, 1e-6);
        ++on_side[axis][p[axis] > 0];
    }
    for (const auto& axis : on_side)
        for (const int count : axis) EXPECT_NEAR(count, 793'800 / 6, 100);
}

TEST_F(SampleTest, SamplesHaveTheAttributesOfTheNearestCorner) {
    const std::string mesh =
        "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
        "property ushort intensity\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
        "0 0 0 100\n1 0 0 200\n0 1 0 300\n3 0 1 2\n";
    const Cloud cloud = read(write("m.ply", mesh), {.format = "", .sample_count = 3000});
    ASSERT_EQ(cloud.attributes.size(), 1u);
    ASSERT_EQ(cloud.attributes[0].values.size(), 3000 * sizeof(std::uint16_t));
    for (std::size_t i = 0; i < 3000; ++i) {
        const Vec3d p = world(cloud, i);
        std::uint16_t value = 0;
        std::memcpy(&value, cloud.attributes[0].values.data() + i * sizeof value, sizeof value);
        const double weights[] = {1 - p[0] - p[1], p[0], p[1]};
        EXPECT_GE(weights[value / 100 - 1], 1 / 3.0 - 1e-6);
        EXPECT_EQ(value % 100, 0);
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
    EXPECT_HAS(reasonOf(write("a.xyz", "1 2 3\n"), {.format = "", .sample_count = 10}), "a.xyz: *no faces");
    EXPECT_EQ(last_code, ExitCode::kBadUsage);
    EXPECT_HAS(reasonOf(write("a.off", kCube), {.format = "", .sample_count = 1ull << 40}), "1099511627776 samples");
    EXPECT_EQ(last_code, ExitCode::kBadUsage);
    EXPECT_HAS(reasonOf(write("b.obj", "v 0 0 0\nf 1 1 1\n"), {.format = "", .sample_count = 10}), "b.obj: *no area");
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
