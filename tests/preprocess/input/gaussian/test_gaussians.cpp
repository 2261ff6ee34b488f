// SPDX-License-Identifier: Apache-2.0
// Gaussians kept as they are, from all formats but SOG and glTF.
#include "tests/preprocess/input/gaussian/gaussian_files.h"

#include <Eigen/Geometry>
#include <numbers>

#include "preprocess/cloud/gaussians.h"
#include "preprocess/input/gaussian/gaussian_transform.h"
#include "preprocess/input/stream.h"

namespace pointrt {
namespace {

using test::Blob, test::gaussianPly, test::joined, test::kQuarterAboutX, test::packedPly, test::plyHeader, test::plyRow,
    test::spz4, test::spzArrays, test::spzHeader, test::splatRow;

using GaussiansTest = InputTest;

/// The columns of a cloud, which must have Gaussians.
GaussianColumns columnsOf(const Cloud& cloud) {
    const auto columns = gaussianColumns(cloud);
    if (!columns) throw std::runtime_error("the cloud has no Gaussians");
    return *columns;
}

Vec3f at3(const float* values, std::size_t i) { return {values[3 * i], values[3 * i + 1], values[3 * i + 2]}; }
Eigen::Quaternionf rotationAt(const GaussianColumns& columns, std::size_t i) {
    const float* const turn = columns.rotation + 4 * i;
    return {turn[0], turn[1], turn[2], turn[3]};
}

/// The colour of a Gaussian seen along a direction.
Vec3d colorAlong(const GaussianColumns& columns, std::size_t i, const Vec3d& direction) {
    Vec3d color = at3(columns.color, i).cast<double>();
    const auto basis = gaussianHarmonics(direction, columns.degree);
    for (std::size_t k = 0; k < static_cast<std::size_t>(gaussianHarmonicCount(columns.degree)); ++k)
        color += basis[k] * at3(columns.harmonics[k], i).cast<double>();
    return color;
}

/// Numbers that differ for each property, below 1.
std::vector<float> restOf(std::size_t count) {
    std::vector<float> rest(count);
    for (std::size_t i = 0; i < count; ++i) rest[i] = 0.02f * static_cast<float>(i) - 0.3f;
    return rest;
}

/// A rotation about no axis in particular.
Eigen::Quaterniond skewTurn() { return Eigen::Quaterniond(0.3, -0.7, 0.4, 0.5).normalized(); }

/// Expects the values of the default Blob.
void expectBlob(const Cloud& cloud, double deviation_error = 1e-6) {
    ASSERT_GE(cloud.positions.size(), 1u);
    const GaussianColumns columns = columnsOf(cloud);
    EXPECT_LT((world(cloud, 0) - Vec3d(1.5, -2, 0.25)).norm(), 1e-6);
    EXPECT_NEAR(columns.opacity[0], 0.8, 1e-6);
    for (int axis = 0; axis < 3; ++axis)
        EXPECT_NEAR(at3(columns.deviation, 0)[axis], std::exp(Vec3d(-2, -3, -5)[axis]), deviation_error);
    EXPECT_NEAR(at3(columns.color, 0)[0], 0.5, 0.01);
    EXPECT_EQ(cloud.colors[0], (Rgb8{128, 255, 0}));
    EXPECT_GT(std::abs(cloud.normals[0].z()), 0.9999f);
    EXPECT_FALSE(cloud.normal_sides);
    EXPECT_NEAR(cloud.radii[0], 2.2 * std::exp(-8 / 3.0), 1e-6);
}

TEST_F(GaussiansTest, TrainedOnesKeepEveryField) {
    const Cloud cloud = readText("a.ply", gaussianPly({{}, {.rotation = kQuarterAboutX, .opacity = 0.01f}}));
    expectBlob(cloud);
    const GaussianColumns columns = columnsOf(cloud);
    EXPECT_EQ(columns.degree, 0);
    EXPECT_NEAR(columns.opacity[1], 0.01, 1e-6);
    EXPECT_LT(
        (at3(columns.color, 1).cast<double>() - (Vec3d::Constant(0.5) + 0.28209479177387814 * Vec3d(0, 9, -9))).norm(),
        1e-6); // not clamped
    EXPECT_TRUE(rotationAt(columns, 0).isApprox(Eigen::Quaternionf::Identity()));
    EXPECT_LT(
        rotationAt(columns, 1)
            .angularDistance(Eigen::Quaternionf(Eigen::AngleAxisf(std::numbers::pi_v<float> / 2, Vec3f::UnitX()))),
        1e-5f);
    EXPECT_GT(std::abs(cloud.normals[1].y()), 0.9999f);
    EXPECT_EQ(cloud.world.up, Vec3d(0, -1, 0));
    EXPECT_SAYS(notesOf(cloud), (folder / "a.ply").string() + ": *2 Gaussians *degree 0*\n");
    EXPECT_EQ(attributeNames(cloud), (Names{"opacity", "gaussian_deviation", "gaussian_rotation", "gaussian_color"}));
}

TEST_F(GaussiansTest, FaintAndHugeOnesAreKept) {
    const Cloud cloud = readText("a.ply", gaussianPly({{.log_deviations = {9, 9, 3}}, {.opacity = 0.001f}, {}}));
    EXPECT_EQ(cloud.positions.size(), 3u);
    EXPECT_NEAR(at3(columnsOf(cloud).deviation, 0).x(), std::exp(9.0f), 0.01f);
}

TEST_F(GaussiansTest, RotationsAreNormalized) {
    const Cloud cloud = readText("a.ply", gaussianPly({{.rotation = {3, 0, 4, 0}}, {.rotation = {0, 0, 0, -1e-30f}}}));
    const GaussianColumns columns = columnsOf(cloud);
    EXPECT_TRUE(rotationAt(columns, 0).isApprox(Eigen::Quaternionf(0.6f, 0, 0.8f, 0)));
    EXPECT_TRUE(rotationAt(columns, 1).isApprox(Eigen::Quaternionf(0, 0, 0, -1)));
}

TEST_F(GaussiansTest, HarmonicsAreStoredByChannel) {
    for (const int degree : {1, 2, 3}) {
        SCOPED_TRACE(degree);
        const auto count = static_cast<std::size_t>(gaussianHarmonicCount(degree));
        const std::vector<float> rest = restOf(3 * count);
        const Cloud cloud = readText("a.ply", gaussianPly({{.rest = std::vector<float>(3 * count)}, {.rest = rest}}));
        const GaussianColumns columns = columnsOf(cloud);
        ASSERT_EQ(columns.degree, degree);
        for (std::size_t k = 0; k < count; ++k)
            EXPECT_EQ(at3(columns.harmonics[k], 1), Vec3f(rest[k], rest[count + k], rest[2 * count + k])) << k;
        EXPECT_EQ(cloud.attributes.size(), 4 + count);
        EXPECT_HAS(notesOf(cloud), fmt::format("2 Gaussians *degree {}", degree));
    }
}

TEST_F(GaussiansTest, OtherNumbersOfHarmonicsAreIgnored) {
    const Cloud seven = readText("a.ply", gaussianPly({{.rest = restOf(7)}}));
    expectBlob(seven);
    EXPECT_EQ(columnsOf(seven).degree, 0);
    EXPECT_HAS(notesOf(seven), "7 *ignored");
}

TEST_F(GaussiansTest, DegreeFourIsReadToDegreeThree) {
    const std::vector<float> rest = restOf(72);
    const Cloud cloud = readText("a.ply", gaussianPly({{.rest = rest}}));
    const GaussianColumns columns = columnsOf(cloud);
    ASSERT_EQ(columns.degree, 3);
    EXPECT_EQ(at3(columns.harmonics[14], 0), Vec3f(rest[14], rest[24 + 14], rest[48 + 14]));
    EXPECT_HAS(notesOf(cloud), "degree 4");
}

TEST_F(GaussiansTest, PackedHarmonicsFollowTheVertices) {
    std::string bytes(9 * 257, '\x80');
    bytes[9 * 256] = '\0';
    bytes[9 * 256 + 4] = '\xff';
    const Cloud cloud = readText("a.ply", packedPly(257, true, test::kNearlyStill, bytes, 9));
    const GaussianColumns columns = columnsOf(cloud);
    ASSERT_EQ(columns.degree, 1);
    const float middle = 8 * (128.5f / 256 - 0.5f);
    EXPECT_EQ(at3(columns.harmonics[0], 0), Vec3f::Constant(middle));
    EXPECT_EQ(at3(columns.harmonics[0], 256), Vec3f(-4, middle, middle));
    EXPECT_EQ(at3(columns.harmonics[1], 256), Vec3f(middle, 4, middle));
    EXPECT_NEAR(columns.color[3 * 256 + 1], 2, 1e-6); // the range of the chunk, not clamped
}

TEST_F(GaussiansTest, InvalidPackedHarmonicsAreRefused) {
    const std::string bytes(9, '\0');
    const std::string good = packedPly(1, true, test::kNearlyStill, bytes, 9);
    const auto with = [&](const std::string& from, const std::string& to) {
        std::string text = good;
        return text.replace(text.find(from), from.size(), to);
    };
    EXPECT_HAS(reasonOfText("a.ply", packedPly(1, true, test::kNearlyStill, bytes + bytes, 9)), "1 packed *'sh'");
    EXPECT_HAS(reasonOfText("a.ply", with("uchar f_rest_3", "char f_rest_3")), "'f_rest_3' *uchar");
    EXPECT_HAS(reasonOfText("a.ply", good.substr(0, good.size() - 1)), "truncated");
    EXPECT_HAS(notesOf(readText("b.ply", packedPly(1, true, test::kNearlyStill, bytes, 1))), "1 *ignored");
}

TEST_F(GaussiansTest, FlatOnesAndNeedlesGetThinAxes) {
    const Cloud flat = readText("a.ply", plyHeader(1, true) + plyRow({}, true));
    EXPECT_NEAR(at3(columnsOf(flat).deviation, 0).z(), std::exp(-2.0f) / 1024, 1e-9f);
    EXPECT_GT(std::abs(flat.normals[0].z()), 0.9999f);
    const Cloud needle = readText("b.ply", gaussianPly({{.log_deviations = {-90, 1, -900}}}));
    EXPECT_TRUE(at3(columnsOf(needle).deviation, 0).isApprox(std::exp(1.0f) * Vec3f(1 / 1024.0f, 1, 1 / 1024.0f)));
}

TEST_F(GaussiansTest, InvalidOnesAreDroppedAndCounted) {
    std::vector<Blob> blobs(9);
    blobs[0].centre[1] = NAN;
    blobs[1].log_deviations[2] = INFINITY;
    blobs[2].log_deviations = {-900, -900, -900};
    blobs[3].rotation = {0, 0, 0, 0};
    blobs[4].rotation[1] = NAN;
    blobs[5].color[2] = -INFINITY;
    blobs[6].opacity = NAN;
    blobs[7].centre = {5, 5, 5};
    for (Blob& blob : blobs) blob.rest = restOf(9);
    blobs[8].rest[8] = NAN;
    const Cloud cloud = readText("a.ply", gaussianPly(blobs));
    EXPECT_EQ(cloud.positions.size(), 1u);
    EXPECT_EQ(cloud.points_non_finite, 8u);
    EXPECT_EQ(world(cloud, 0), Vec3d(5, 5, 5));
    EXPECT_HAS(notesOf(cloud), "9 Gaussians *left out: 8 ");
    EXPECT_HAS(reasonOfText("b.ply", gaussianPly({blobs[3]})), "none of its 1 Gaussians");
}

TEST_F(GaussiansTest, LogitsMayHaveAnySize) {
    std::string text = gaussianPly({{}, {}});
    const std::size_t opacity_at = plyHeader(2).size() + 36, row = plyRow({}).size();
    text.replace(opacity_at, 4, bytesOf(1e30f));
    text.replace(opacity_at + row, 4, bytesOf(-1e30f));
    const Cloud cloud = readText("a.ply", text);
    EXPECT_EQ(numbersOf(cloud, "opacity"), (Numbers{1, 0}));
}

TEST_F(GaussiansTest, NerfstudioColoursAreNoHarmonics) {
    std::string text =
        "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\n";
    for (const char* name : {"red", "green", "blue"}) text += fmt::format("property uchar {}\n", name);
    for (const char* name : {"opacity", "scale_0", "scale_1", "scale_2", "rot_0", "rot_1", "rot_2", "rot_3"})
        text += fmt::format("property float {}\n", name);
    const Cloud cloud = readText("a.ply", text + "end_header\n1.5 -2 0.25  51 102 255  1.3862944  -2 -3 -5  1 0 0 0\n");
    const GaussianColumns columns = columnsOf(cloud);
    EXPECT_TRUE(at3(columns.color, 0).isApprox(Vec3f(0.2f, 0.4f, 1)));
    EXPECT_NEAR(columns.opacity[0], 0.8, 1e-6);
    EXPECT_EQ(cloud.colors[0], (Rgb8{51, 102, 255}));
    EXPECT_NEAR(at3(columns.deviation, 0).z(), std::exp(-5.0f), 1e-6f);
}

TEST_F(GaussiansTest, SplatFilesKeepEveryField) {
    const Cloud cloud = readText("a.splat", splatRow({}) + splatRow({.rotation = kQuarterAboutX}) +
                                                splatRow({.rotation = {0, 0, 0, 0}}));
    expectBlob(cloud);
    EXPECT_EQ(cloud.positions.size(), 2u); // the last one has no rotation
    EXPECT_LT(
        rotationAt(columnsOf(cloud), 1)
            .angularDistance(Eigen::Quaternionf(Eigen::AngleAxisf(std::numbers::pi_v<float> / 2, Vec3f::UnitX()))),
        0.02f);
    EXPECT_HAS(notesOf(cloud), "3 Gaussians *left out: 1 ");
}

TEST_F(GaussiansTest, SpzKeepsEveryField) {
    for (const std::uint32_t version : {1u, 2u, 3u}) {
        SCOPED_TRACE(version);
        expectBlob(readText("a.spz", spzHeader({version}) + joined(spzArrays(version))), 1e-6);
    }
    expectBlob(readText("b.spz", spz4(spzArrays(4))));
}

TEST_F(GaussiansTest, SpzHarmonicsAreStoredByCoefficient) {
    std::string bytes(24, '\x80');
    bytes[0] = '\0';
    bytes[3 * 7 + 2] = '\xc0';
    std::vector<std::string> arrays = spzArrays(4);
    arrays.push_back(bytes);
    for (const std::string& text : {spzHeader({3, 1, 2}) + joined(spzArrays(3)) + bytes,
                                    spz4(arrays, {.version = 4, .degree = 2, .streams = 6})}) {
        const Cloud cloud = readText("a.spz", text);
        const GaussianColumns columns = columnsOf(cloud);
        ASSERT_EQ(columns.degree, 2);
        EXPECT_EQ(at3(columns.harmonics[0], 0), Vec3f(-1, 0, 0));
        EXPECT_EQ(at3(columns.harmonics[7], 0), Vec3f(0, 0, 0.5f));
    }
    const Cloud fourth = readText("b.spz", spzHeader({3, 1, 4}) + joined(spzArrays(3)) + std::string(72, '\x81'));
    EXPECT_EQ(columnsOf(fourth).degree, 3);
    EXPECT_HAS(notesOf(fourth), "degree 4");
}

TEST_F(GaussiansTest, InvalidSpzHarmonicsAreRefused) {
    const std::string body = joined(spzArrays(3));
    EXPECT_HAS(reasonOfText("a.spz", spzHeader({3, 1, 1}) + body), "truncated: *promises 1 ");
    EXPECT_HAS(reasonOfText("a.spz", spzHeader({3, 1, 5}) + body + std::string(999, '\0')), "degree 5");
    EXPECT_HAS(reasonOfText("a.spz", spz4(spzArrays(4), {.version = 4, .degree = 1})), "5 streams*6");
}

TEST_F(GaussiansTest, FilesOfAllDegreesMerge) {
    const std::string plain = write("a.ply", gaussianPly({{}}));
    const std::string first = write("b.ply", gaussianPly({{.rest = restOf(9)}}));
    const std::string third = write("c.ply", gaussianPly({{.rest = restOf(45)}}));
    const Cloud cloud = readInputs({plain, third, first}, {});
    const GaussianColumns columns = columnsOf(cloud);
    ASSERT_EQ(columns.degree, 3);
    for (const float* const harmonic : columns.harmonics) EXPECT_TRUE(at3(harmonic, 0).isZero(0));
    EXPECT_EQ(at3(columns.harmonics[2], 1), Vec3f(restOf(45)[2], restOf(45)[17], restOf(45)[32]));
    EXPECT_EQ(at3(columns.harmonics[2], 2), Vec3f(restOf(9)[2], restOf(9)[5], restOf(9)[8]));
    EXPECT_TRUE(at3(columns.harmonics[3], 2).isZero(0));
}

TEST_F(GaussiansTest, PointsAmongThemAreMarked) {
    const Cloud cloud = readInputs({write("a.ply", gaussianPly({{}})), write("b.xyz", "0 0 0\n")}, {});
    const GaussianColumns columns = columnsOf(cloud);
    EXPECT_FALSE(std::isnan(columns.opacity[0]));
    EXPECT_TRUE(std::isnan(columns.opacity[1]));
    EXPECT_FALSE(gaussianColumns(readText("c.xyz", "0 0 0\n1 1 1\n")));
}

TEST_F(GaussiansTest, NoChoiceOfAttributesRemovesThem) {
    ReadOptions options;
    options.attributes = {.all = false, .names = {}};
    expectBlob(read(write("a.ply", gaussianPly({{.rest = restOf(9)}})), options));
    EXPECT_EQ(columnsOf(read(write("a.ply", gaussianPly({{.rest = restOf(9)}})), options)).degree, 1);
    // in files of points, these are ordinary attributes
    const std::string point = "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\n"
                              "property float z\nproperty float opacity\nend_header\n1 2 3 4\n";
    EXPECT_TRUE(read(write("b.ply", point), options).attributes.empty());
}

TEST_F(GaussiansTest, FiltersKeepValuesWithTheirPoints) {
    std::vector<Blob> blobs(8);
    for (std::size_t i = 0; i < blobs.size(); ++i) {
        blobs[i].centre[0] = static_cast<float>(i);
        blobs[i].log_deviations[0] = static_cast<float>(i);
    }
    ReadOptions options;
    options.filter.every = 3;
    const Cloud cloud = read(write("a.ply", gaussianPly(blobs)), options);
    ASSERT_EQ(cloud.positions.size(), 3u);
    for (std::size_t i = 0; i < 3; ++i)
        EXPECT_NEAR(std::log(columnsOf(cloud).deviation[3 * i]), world(cloud, i).x(), 1e-5);
}

TEST_F(GaussiansTest, BatchesHaveThem) {
    StreamOptions options;
    options.read.attributes = {.all = false, .names = {}};
    options.read.transform = Eigen::Affine3d(Eigen::Scaling(2.0));
    const std::vector<std::string> paths = {write("a.ply", gaussianPly({{.rest = restOf(9)}})),
                                            write("b.ply", gaussianPly({{}, {}}))};
    std::size_t seen = 0;
    const auto take = [&](const PointBatch& batch) {
        for (std::size_t i = 0; i < batch.positions.size(); ++i)
            EXPECT_NEAR(at3(columnsOf(batch.cloud).deviation, i).x(), 2 * std::exp(-2.0f), 1e-6f); // scaled once
        seen += batch.positions.size();
        if (batch.scan == 1) {
            EXPECT_TRUE(at3(columnsOf(batch.cloud).harmonics[0], 0).isZero(0));
        }
    };
    const StreamFindings first = readInBatches(paths, options, [](const PointBatch&) {});
    options.first_pass = &first;
    readInBatches(paths, options, take);
    EXPECT_EQ(seen, 3u);
}

TEST_F(GaussiansTest, TransformsTurnAndScaleThem) {
    const Eigen::Quaterniond turn = skewTurn();
    ReadOptions options;
    options.transform = Eigen::Translation3d(1, 2, 3) * turn * Eigen::Scaling(2.5);
    const std::string path = write("a.ply", gaussianPly({{.rotation = kQuarterAboutX, .rest = restOf(45)}}));
    const Cloud before = read(path), after = read(path, options);
    const GaussianColumns from = columnsOf(before), to = columnsOf(after);
    EXPECT_LT((world(after, 0) - *options.transform * world(before, 0)).norm(), 1e-5);
    EXPECT_TRUE(at3(to.deviation, 0).isApprox(2.5f * at3(from.deviation, 0), 1e-5f));
    EXPECT_LT(rotationAt(to, 0).angularDistance(turn.cast<float>() * rotationAt(from, 0)), 1e-5f);
    EXPECT_NEAR(after.radii[0], 2.5f * before.radii[0], 1e-5f);
    EXPECT_GT(std::abs(after.normals[0].cast<double>().normalized().dot(turn * before.normals[0].cast<double>())),
              0.9999);
    for (const Vec3d& direction : {Vec3d(1, 0, 0), Vec3d(0.36, -0.48, 0.8), Vec3d(-0.6, 0.8, 0)})
        EXPECT_LT((colorAlong(to, 0, turn * direction) - colorAlong(from, 0, direction)).norm(), 1e-5);
}

TEST_F(GaussiansTest, PosesOfScansTurnThem) {
    write("a.ply", gaussianPly({{.rest = restOf(9)}}));
    // the quaternions of these files turn from the world to the scan
    const Cloud cloud = readText("a.conf", "bmesh a.ply 1 0 0  0 0 0.70710678 0.70710678\n");
    const Eigen::AngleAxisd turn(-std::numbers::pi / 2, Vec3d::UnitZ());
    const GaussianColumns columns = columnsOf(cloud);
    EXPECT_LT(rotationAt(columns, 0).angularDistance(Eigen::Quaterniond(turn).cast<float>()), 1e-5f);
    const Cloud still = read((folder / "a.ply").string());
    EXPECT_LT((colorAlong(columns, 0, turn * Vec3d(0, 0.6, 0.8)) - colorAlong(columnsOf(still), 0, Vec3d(0, 0.6, 0.8)))
                  .norm(),
              1e-5);
}

TEST_F(GaussiansTest, MirrorsAndSkewsAreRefused) {
    const std::string path = write("a.ply", gaussianPly({{}}));
    ReadOptions options;
    options.transform = Eigen::Affine3d(Eigen::Scaling(-1.0, 1.0, 1.0));
    EXPECT_HAS(reasonOf(path, options), "a.ply: *mirrors");
    options.transform = Eigen::Affine3d(Eigen::Scaling(1.0, 1.0, 1.1));
    EXPECT_HAS(reasonOf(path, options), "a.ply: *different axes");
    options.transform = Eigen::Affine3d(Eigen::Scaling(0.0, 0.0, 0.0));
    EXPECT_HAS(reasonOf(path, options), "a.ply: *different axes");
    options.gaussians_as_discs = true;
    options.transform = Eigen::Affine3d(Eigen::Scaling(-1.0, 1.0, 1.0));
    EXPECT_EQ(read(path, options).positions.size(), 1u);
}

TEST_F(GaussiansTest, EveryPrefixIsReadOrRefused) {
    readPrefixes("a.ply", gaussianPly({{.rest = restOf(9)}}));
    readPrefixes("b.ply", packedPly(1, true, test::kNearlyStill, std::string(9, '\1'), 9));
    readPrefixes("a.splat", splatRow({}) + splatRow({}));
    std::vector<std::string> arrays = spzArrays(4);
    arrays.emplace_back(9, '\1');
    readPrefixes("a.spz", spzHeader({3, 1, 1}) + joined(spzArrays(3)) + std::string(9, '\1'));
    readPrefixes("b.spz", gzipped(spzHeader({2}) + joined(spzArrays(2))));
    readPrefixes("c.spz", spz4(arrays, {.version = 4, .degree = 1, .streams = 6}));
}

/// The functions of the reference implementation (Kerbl et al. 2023, forward.cu), copied as written there.
TEST(GaussianHarmonics, AreThoseOfTheReference) {
    const Vec3d direction = Vec3d(0.3, -0.5, 0.8).normalized();
    const double x = direction.x(), y = direction.y(), z = direction.z();
    const double xx = x * x, yy = y * y, zz = z * z, xy = x * y, yz = y * z, xz = x * z;
    const double expected[] = {-0.4886025119029199 * y,
                               0.4886025119029199 * z,
                               -0.4886025119029199 * x,
                               1.0925484305920792 * xy,
                               -1.0925484305920792 * yz,
                               0.31539156525252005 * (2.0 * zz - xx - yy),
                               -1.0925484305920792 * xz,
                               0.5462742152960396 * (xx - yy),
                               -0.5900435899266435 * y * (3.0 * xx - yy),
                               2.890611442640554 * xy * z,
                               -0.4570457994644658 * y * (4.0 * zz - xx - yy),
                               0.3731763325901154 * z * (2.0 * zz - 3.0 * xx - 3.0 * yy),
                               -0.4570457994644658 * x * (4.0 * zz - xx - yy),
                               1.445305721320277 * z * (xx - yy),
                               -0.5900435899266435 * x * (xx - 3.0 * yy)};
    const auto values = gaussianHarmonics(direction, 3);
    for (std::size_t k = 0; k < values.size(); ++k) EXPECT_NEAR(values[k], expected[k], 1e-12) << k;
    EXPECT_EQ(gaussianHarmonics(direction, 1)[3], 0);
}

/// Integrals over the sphere: that of a product of two functions is 1 if they are the same and 0 otherwise.
TEST(GaussianHarmonics, AreOrthonormal) {
    constexpr int kRings = 64, kSteps = 16; // exact for polynomials of degree 6 along azimuth, and nearly so along z
    Eigen::Matrix<double, 15, 15> integrals = Eigen::Matrix<double, 15, 15>::Zero();
    for (int ring = 0; ring < kRings; ++ring)
        for (int step = 0; step < kSteps; ++step) {
            const double z = -1 + (2 * ring + 1.0) / kRings, angle = 2 * std::numbers::pi * step / kSteps;
            const double radius = std::sqrt(1 - z * z);
            const auto values = gaussianHarmonics({radius * std::cos(angle), radius * std::sin(angle), z}, 3);
            const Eigen::Map<const Eigen::Matrix<double, 15, 1>> column(values.data());
            integrals += 4 * std::numbers::pi / (kRings * kSteps) * column * column.transpose();
        }
    EXPECT_LT((integrals - Eigen::Matrix<double, 15, 15>::Identity()).cwiseAbs().maxCoeff(), 0.01);
}

TEST(GaussianHarmonics, RotationsAreOrthogonalAndCompose) {
    const Eigen::Matrix3d first = skewTurn().toRotationMatrix();
    const Eigen::Matrix3d second = Eigen::AngleAxisd(2, Vec3d(1, 2, -3).normalized()).toRotationMatrix();
    for (const int degree : {1, 2, 3}) {
        const Eigen::MatrixXd turn = harmonicRotation(first, degree);
        ASSERT_EQ(turn.rows(), 2 * degree + 1);
        EXPECT_TRUE((turn * turn.transpose()).isIdentity(1e-12)) << degree;
        EXPECT_TRUE(
            (harmonicRotation(second, degree) * turn).isApprox(harmonicRotation(second * first, degree), 1e-12));
        EXPECT_TRUE(harmonicRotation(Eigen::Matrix3d::Identity(), degree).isIdentity(1e-12));
    }
}

} // namespace
} // namespace pointrt
