// SPDX-License-Identifier: Apache-2.0
// Attributes of several files merged into one cloud, and filtered points.
#include <cmath>

#include "input_fixture.h"
#include "preprocess/ingest/columns.h"
#include "preprocess/ingest/scalar.h"
#include "preprocess/ingest/sink.h"

namespace pointrt {
namespace {

double valueOf(const Attribute& attribute, std::size_t point, std::size_t component = 0) {
    const std::size_t place = point * attribute.components + component;
    return loadScalar(attribute.values.data() + place * scalarSize(attribute.type), attribute.type, false);
}

/// Reads synthetic files: points 0, 1, 2 ... on the x axis.
struct ColumnsTest : testing::Test {
    Cloud cloud;
    Sink sink{cloud};
    InputFile input{"a.las", "x", nullptr};

    template <typename Value>
    void addFile(const std::string& name, Scalar type, const std::vector<Value>& values, bool untyped = false) {
        ScanTraits traits;
        traits.columns = {{name, type, 1, untyped}};
        sink.beginScan(input, traits);
        for (const Value value : values) sink.addVertex(position(), bytesOf(value).data());
        sink.finishScan(input);
    }
    void addBareFile(std::size_t points) {
        sink.beginScan(input, {});
        for (std::size_t i = 0; i < points; ++i) sink.addVertex(position());
        sink.finishScan(input);
    }
    Row position() {
        Row row{};
        row[kX] = next++;
        return row;
    }
    const Attribute& only() const {
        EXPECT_EQ(cloud.attributes.size(), 1u);
        EXPECT_EQ(cloud.attributes[0].values.size(), cloud.positions.size() * cloud.attributes[0].bytesEach());
        return cloud.attributes[0];
    }
    double next = 0;
};

TEST_F(ColumnsTest, KeepTheirTypeAndBits) {
    addFile<std::uint16_t>("intensity", Scalar::kU16, {0, 65535, 7});
    EXPECT_EQ(only().type, Scalar::kU16);
    EXPECT_EQ(only().values, (std::vector<char>{0, 0, char(255), char(255), 7, 0}));
}

TEST_F(ColumnsTest, FilesThatLackOneGetItsFill) {
    addBareFile(1);
    addFile<std::uint8_t>("classification", Scalar::kU8, {6});
    addBareFile(1);
    EXPECT_EQ(only().values, (std::vector<char>{0, 6, 0}));
}

TEST_F(ColumnsTest, RealsAreFilledWithNaN) {
    addBareFile(1);
    addFile<double>("gps_time", Scalar::kF64, {2.5});
    EXPECT_TRUE(std::isnan(valueOf(only(), 0)));
    EXPECT_EQ(valueOf(only(), 1), 2.5);
}

TEST_F(ColumnsTest, TypesGrowUntilTheyHoldAll) {
    addFile<std::uint8_t>("a", Scalar::kU8, {255});
    addFile<std::int8_t>("a", Scalar::kI8, {-3});
    EXPECT_EQ(only().type, Scalar::kI16);
    addFile<std::uint32_t>("a", Scalar::kU32, {4000000000u});
    EXPECT_EQ(only().type, Scalar::kI64);
    EXPECT_EQ(valueOf(only(), 0), 255);
    EXPECT_EQ(valueOf(only(), 1), -3);
    EXPECT_EQ(valueOf(only(), 2), 4e9);
    addFile<float>("a", Scalar::kF32, {0.5f});
    EXPECT_EQ(only().type, Scalar::kF64);
    EXPECT_EQ(valueOf(only(), 1), -3);
    EXPECT_EQ(valueOf(only(), 3), 0.5);
}

TEST_F(ColumnsTest, NarrowFileAfterAWideOne) {
    addFile<float>("a", Scalar::kF32, {0.5f});
    addFile<std::int16_t>("a", Scalar::kI16, {-7});
    EXPECT_EQ(only().type, Scalar::kF32);
    EXPECT_EQ(valueOf(only(), 1), -7);
}

TEST_F(ColumnsTest, UntypedAttributesShrinkWithoutLoss) {
    addFile<double>("whole", Scalar::kF64, {0, 300}, true);
    narrowAttributes(cloud, sink.columns);
    EXPECT_EQ(cloud.attributes[0].type, Scalar::kU16);
    EXPECT_EQ(valueOf(cloud.attributes[0], 1), 300);
}

TEST_F(ColumnsTest, UntypedRealsKeepEveryBit) {
    addFile<double>("half", Scalar::kF64, {0.5, -2}, true);
    addFile<double>("time", Scalar::kF64, {0.1}, true);
    narrowAttributes(cloud, sink.columns);
    EXPECT_EQ(cloud.attributes[0].type, Scalar::kF32);
    EXPECT_EQ(cloud.attributes[1].type, Scalar::kF64);
    EXPECT_EQ(valueOf(cloud.attributes[1], 2), 0.1);
}

TEST_F(ColumnsTest, LargeUntypedIntegersStayIntegers) {
    constexpr std::int64_t kOdd = (std::int64_t{1} << 53) + 1; // not representable as a double
    addFile<std::int64_t>("id", Scalar::kI64, {kOdd, std::int64_t{1} << 40}, true);
    narrowAttributes(cloud, sink.columns);
    EXPECT_EQ(only().type, Scalar::kI64);
    EXPECT_EQ(loadWhole(only().values.data(), Scalar::kI64), static_cast<std::uint64_t>(kOdd));
}

TEST_F(ColumnsTest, DeclaredTypesStay) {
    addFile<double>("time", Scalar::kF64, {1}, true);
    addFile<double>("time", Scalar::kF64, {2}, false);
    narrowAttributes(cloud, sink.columns);
    EXPECT_EQ(cloud.attributes[0].type, Scalar::kF64);
}

TEST_F(ColumnsTest, MinorOnesTakeNoMemoryUntilThereIsMoreThanZero) {
    ScanTraits traits;
    traits.faces = false;
    traits.columns = {{"withheld", Scalar::kU8}, {"overlap", Scalar::kU8}};
    for (ColumnTraits& column : traits.columns) column.minor = true;
    sink.beginScan(input, traits);
    const std::vector<Vec3d> positions{Vec3d(1, 0, 0), Vec3d(2, 0, 0)};
    const char zeros[] = {0, 0}, one[] = {0, 1};
    const char* const nothing[] = {zeros, zeros};
    const char* const something[] = {one, zeros};
    sink.addVertices(positions, nothing);
    EXPECT_TRUE(cloud.attributes[0].values.empty());
    sink.addVertices(positions, something);
    sink.addVertices(positions, nothing);
    sink.finishScan(input);
    EXPECT_TRUE(cloud.attributes[1].values.empty());
    dropMinorAttributes(cloud, sink.columns);
    EXPECT_EQ(only().name, "withheld");
    EXPECT_EQ(only().values, (std::vector<char>{0, 0, 0, 1, 0, 0}));
}

TEST_F(ColumnsTest, OnlySelectedOnes) {
    sink.attributes = {false, {"b"}};
    addFile<std::uint8_t>("a", Scalar::kU8, {1});
    addFile<std::uint8_t>("b", Scalar::kU8, {2});
    EXPECT_EQ(only().name, "b");
    EXPECT_EQ(only().values, (std::vector<char>{0, 2}));
}

TEST_F(ColumnsTest, WideColorsComeFromTheirAttribute) {
    ScanTraits traits;
    traits.colors = true;
    traits.color_scale = ColorScale::k16Bit;
    traits.columns = {{"intensity", Scalar::kU8}, {kRgb16, Scalar::kU16, 3}};
    sink.beginScan(input, traits);
    sink.addVertex(
        position(),
        ("\x09" + bytesOf<std::uint16_t>(65535) + bytesOf<std::uint16_t>(256) + bytesOf<std::uint16_t>(255)).data());
    sink.finishScan(input);
    EXPECT_EQ(cloud.colors[0], (Rgb8{255, 1, 0}));
    ASSERT_EQ(cloud.attributes.size(), 2u);
    EXPECT_EQ(valueOf(cloud.attributes[1], 0, 2), 255);
}

TEST_F(ColumnsTest, BytesInWideColorsStayBytes) {
    sink.attributes.all = false;
    ScanTraits traits;
    traits.colors = true;
    traits.color_scale = ColorScale::k16Bit;
    traits.columns = {{kRgb16, Scalar::kU16, 3}};
    sink.beginScan(input, traits);
    sink.addVertex(position(),
                   (bytesOf<std::uint16_t>(254) + bytesOf<std::uint16_t>(1) + bytesOf<std::uint16_t>(0)).data());
    sink.finishScan(input);
    EXPECT_EQ(cloud.colors[0], (Rgb8{254, 1, 0}));
    EXPECT_TRUE(cloud.attributes.empty());
}

struct FilterTest : InputTest {
    /// Twelve points on the x axis, an eighth apart.
    std::string line() {
        std::string text;
        for (int i = 0; i < 12; ++i) text += fmt::format("{} 0 {}\n", i / 8.0, i % 2);
        return write("line.xyz", text);
    }
    std::size_t count(const ReadOptions& options) {
        const Cloud cloud = read(line(), options);
        EXPECT_EQ(cloud.points_read, 12u);
        EXPECT_EQ(cloud.points_filtered, 12 - cloud.positions.size());
        return cloud.positions.size();
    }
};

TEST_F(FilterTest, Bounds) {
    ReadOptions options;
    options.filter.bounds = Eigen::AlignedBox3d(Vec3d(0.375, -1, 0), Vec3d(0.75, 1, 1));
    EXPECT_EQ(count(options), 4u) << "bounds are closed";
    options.filter.bounds = Eigen::AlignedBox3d(Vec3d(0.375, -1, 0), Vec3d(0.75, 1, 0));
    EXPECT_EQ(count(options), 2u);
}

TEST_F(FilterTest, NothingLeftIsAnError) {
    ReadOptions options;
    options.filter.bounds = Eigen::AlignedBox3d(Vec3d(7, 7, 7), Vec3d(8, 8, 8));
    EXPECT_HAS(reasonOf(line(), options), "line.xyz: *12 *filters");
    EXPECT_EQ(last_code, ExitCode::kBadInput);
}

TEST_F(FilterTest, EveryCountsOverAllFiles) {
    ReadOptions options;
    options.filter.every = 5;
    EXPECT_EQ(count(options), 3u);
    const std::string path = line();
    const Cloud two = readInputs({path, path}, options);
    ASSERT_EQ(two.positions.size(), 5u);
    EXPECT_EQ(two.positions[3].x(), 0.375f) << "the fifteenth point is the fourth of the second file";
}

TEST_F(FilterTest, ThinKeepsTheFirstOfEachCell) {
    ReadOptions options;
    options.filter.thin_spacing = 0.45; // cells in x from 0, 0.45, 0.9, 1.35, in z 0 and 2
    const Cloud cloud = read(line(), options);
    EXPECT_EQ(cloud.positions.size(), 7u);
    EXPECT_EQ(cloud.positions[2].x(), 0.5f) << "after 0 and, in the upper layer, 0.125";
    options.filter.thin_spacing = 10;
    EXPECT_EQ(count(options), 1u);
}

TEST_F(FilterTest, ClassesNeedSome) {
    ReadOptions options;
    options.filter.keep_classes.assign(256, true);
    EXPECT_HAS(reasonOf(line(), options), "line.xyz: *classes");
}

TEST_F(FilterTest, TransformMovesAllButItsNormalsStayNormal) {
    const std::string path = write("n.xyz", "1 2 3 0 0.6 0.8\n4 5 7 0 0.6 0.8\n");
    ReadOptions options;
    Eigen::Matrix4d matrix;
    matrix << 2, 0, 0, 10, 0, 1, 0, 20, 0, 0, 1, 30, 0, 0, 0, 1;
    options.transform = Eigen::Affine3d(matrix);
    const Cloud cloud = read(path, options);
    EXPECT_EQ(world(cloud, 1), Vec3d(18, 25, 37));
    ASSERT_EQ(cloud.normals.size(), 2u);
    EXPECT_NEAR(cloud.normals[0].normalized().y(), 0.6, 1e-6) << "transformed by the inverse transpose";
    options.filter.bounds = Eigen::AlignedBox3d(Vec3d(18, 25, 37), Vec3d(18, 25, 37));
    EXPECT_EQ(read(path, options).positions.size(), 1u) << "bounds apply after the transform";
}

TEST_F(FilterTest, ScansAreNumbered) {
    const std::string path = line();
    const Cloud cloud = readInputs({path, path}, {});
    ASSERT_EQ(cloud.attributes.size(), 1u);
    EXPECT_EQ(cloud.attributes[0].name, "scan");
    EXPECT_EQ(cloud.attributes[0].type, Scalar::kU8);
    EXPECT_EQ(valueOf(cloud.attributes[0], 11), 0);
    EXPECT_EQ(valueOf(cloud.attributes[0], 12), 1);
    EXPECT_TRUE(read(path).attributes.empty());
}

TEST_F(InputTest, CellSetDistinguishesCells) {
    CellSet cells;
    constexpr std::int64_t kFar = std::int64_t{1} << 41;
    int there = 0;
    for (int round = 0; round < 2; ++round)
        for (const std::int64_t x : {-kFar, std::int64_t{-1}, std::int64_t{0}, std::int64_t{1}, kFar - 1})
            for (std::int64_t y = -20; y < 20; ++y)
                for (const std::int64_t z : {-kFar, std::int64_t{-7}, kFar - 1}) there += cells.insert(x, y, z);
    EXPECT_EQ(there, 5 * 40 * 3);
}

} // namespace
} // namespace pointrt
