// SPDX-License-Identifier: Apache-2.0
// LAS, LAZ and COPC files as clouds.
#include "tests/preprocess/input/input_fixture.h"
#include "tests/support/find_attribute.h"
#include "tests/support/las_file.h"
#include "tests/support/packed_las.h"

#include "format/pointio/las_fields.h"
#include "format/pointio/laz.h"

namespace pointrt {
namespace {

using test::findAttribute;
using test::LasParts;
using test::lasPoint;
using test::lasRecord;
using test::put;

template <typename Number>
std::vector<Number> valuesOf(const Cloud& cloud, const std::string& name) {
    const Attribute* const attribute = findAttribute(cloud, name);
    if (!attribute) {
        ADD_FAILURE() << "no " << name;
        return {};
    }
    EXPECT_EQ(scalarSize(attribute->type), sizeof(Number)) << name;
    std::vector<Number> numbers(attribute->values.size() / sizeof(Number));
    std::memcpy(numbers.data(), attribute->values.data(), attribute->values.size());
    return numbers;
}

/// Points on a line, the k-th with intensity 100 + k, class k % 4 and a colour.
std::vector<std::string> linePoints(std::uint8_t format, int count) {
    std::vector<std::string> points;
    for (int k = 0; k < count; ++k) {
        std::string point(lasRecordBytes(format), '\0');
        put(point, 0, k);
        put(point, 4, 2 * k);
        put(point, 8, -k);
        put(point, 12, static_cast<std::uint16_t>(100 + k));
        point[14] = 0b01'001;
        point[format < 6 ? 15 : 16] = static_cast<char>(k % 4);
        for (const LasField& field : lasFields(format))
            if (field.name == "rgb16")
                for (std::size_t c = 0; c < 3; ++c)
                    put(point, field.at + 2 * c, static_cast<std::uint16_t>(k == 0 ? 0xFFFF : 256 * c + k));
        points.push_back(point);
    }
    return points;
}

struct LasTest : InputTest {
    Cloud readParts(const LasParts& parts, const ReadOptions& options = {}) const {
        return read(write("a.las", parts.bytes()), options);
    }
};

TEST_F(LasTest, PointsHaveScaleAndOffset) {
    LasParts parts;
    parts.scale = 0.25;
    parts.offset[0] = 500000;
    parts.offset[1] = -3;
    parts.points = linePoints(0, 3);
    const Cloud cloud = readParts(parts);
    ASSERT_EQ(cloud.positions.size(), 3u);
    EXPECT_EQ(world(cloud, 2), Vec3d(500000.5, -2, -0.5));
    EXPECT_TRUE(cloud.colors.empty());
    EXPECT_EQ(cloud.world.up, Vec3d(0, 0, 1));
    EXPECT_EQ(cloud.world.metres_per_unit, 0);
    EXPECT_FALSE(cloud.source_header.empty());
}

TEST_F(LasTest, AttributesAreThoseOfTheRecords) {
    LasParts parts;
    parts.format = 3;
    parts.points = linePoints(3, 5);
    const Cloud cloud = readParts(parts);
    EXPECT_EQ(valuesOf<std::uint16_t>(cloud, "intensity"), (std::vector<std::uint16_t>{100, 101, 102, 103, 104}));
    EXPECT_EQ(valuesOf<std::uint8_t>(cloud, "classification"), (std::vector<std::uint8_t>{0, 1, 2, 3, 0}));
    EXPECT_EQ(valuesOf<std::uint16_t>(cloud, "rgb16")[3 + 2], 513);
    ASSERT_EQ(cloud.colors.size(), 5u);
    EXPECT_EQ(cloud.colors[0], (Rgb8{255, 255, 255}));
    EXPECT_EQ(cloud.colors[1], (Rgb8{0, 1, 2})); // the upper bytes, since one value exceeds 255
    for (const char* minor : {"synthetic", "key_point", "withheld", "edge_of_flight_line", "user_data"})
        EXPECT_EQ(findAttribute(cloud, minor), nullptr) << minor;
    ReadOptions options;
    options.attributes = {false, {"withheld"}};
    EXPECT_NE(findAttribute(readParts(parts, options), "withheld"), nullptr) << "selected by name";
    parts.points[4][15] = '\x80';
    EXPECT_EQ(valuesOf<std::uint8_t>(readParts(parts), "withheld"), (std::vector<std::uint8_t>{0, 0, 0, 0, 1}));
}

TEST_F(LasTest, BlackColoursAreNone) {
    LasParts parts;
    parts.format = 2;
    parts.points = {lasPoint(26, 1, 2, 3, 0)};
    for (std::size_t at = 12; at < 26; ++at) parts.points[0][at] = 0;
    const Cloud cloud = readParts(parts);
    EXPECT_TRUE(cloud.colors.empty());
    ASSERT_EQ(cloud.notes.size(), 1u);
    EXPECT_HAS(cloud.notes[0].text, "black");
}

TEST_F(LasTest, FiltersSeeClassesAndPlaces) {
    LasParts parts;
    parts.points = linePoints(0, 40);
    ReadOptions options;
    options.filter.keep_classes.assign(256, false);
    options.filter.keep_classes[2] = true;
    Cloud cloud = readParts(parts, options);
    EXPECT_EQ(cloud.positions.size(), 10u);
    EXPECT_EQ(valuesOf<std::uint8_t>(cloud, "classification"), std::vector<std::uint8_t>(10, 2));
    EXPECT_EQ(valuesOf<std::uint16_t>(cloud, "intensity")[9], 138);
    options = {};
    options.filter.bounds = Eigen::AlignedBox3d(Vec3d(0.1, 0, -1), Vec3d(0.2, 1, 1));
    cloud = readParts(parts, options);
    EXPECT_EQ(cloud.positions.size(), 11u);
    EXPECT_EQ(cloud.points_filtered, 29u);
    options = {};
    options.filter.every = 7;
    EXPECT_EQ(readParts(parts, options).positions.size(), 6u);
}

TEST_F(LasTest, LazIsReadAsLas) {
    if (!hasLaz()) GTEST_SKIP() << "this build has no LAZ";
    for (const std::uint8_t format : {0, 1, 2, 3, 6, 7, 8}) {
        const auto points = linePoints(format, 70000); // two chunks
        const Cloud packed = read(write("a.laz", test::writeLas(format, points, true)));
        const Cloud plain = read(write("a.las", test::writeLas(format, points, false)));
        ASSERT_EQ(packed.positions, plain.positions);
        EXPECT_EQ(packed.colors, plain.colors);
        ASSERT_EQ(packed.attributes.size(), plain.attributes.size());
        for (std::size_t i = 0; i < packed.attributes.size(); ++i)
            EXPECT_EQ(packed.attributes[i].values, plain.attributes[i].values) << packed.attributes[i].name;
    }
}

TEST_F(LasTest, SkimsTheBeginningOfEachChunk) {
    if (!hasLaz()) GTEST_SKIP() << "this build has no LAZ";
    ReadOptions options;
    options.skim = 0.01;
    for (const std::uint8_t format : {0, 6}) {
        const auto points = linePoints(format, 70000); // chunks of 50,000 and 20,000
        const Cloud skimmed = read(write("a.laz", test::writeLas(format, points, true)), options);
        const Cloud whole = read(write("a.las", test::writeLas(format, points, false)), options);
        ASSERT_EQ(whole.positions.size(), 70000u) << "points that are not packed need no time to unpack";
        ASSERT_EQ(skimmed.positions.size(), 700u);
        for (const std::size_t i : {0u, 499u}) EXPECT_EQ(skimmed.positions[i], whole.positions[i]);
        for (const std::size_t i : {0u, 199u}) EXPECT_EQ(skimmed.positions[500 + i], whole.positions[50000 + i]);
    }
}

TEST_F(LasTest, WithoutRustTheErrorNamesWhatToInstall) {
    if (hasLaz()) GTEST_SKIP() << "this build has LAZ";
    LasParts parts;
    parts.packed = true;
    parts.points = linePoints(0, 1);
    EXPECT_HAS(reasonOf(write("a.laz", parts.bytes())), "install Rust");
    EXPECT_EQ(last_code, ExitCode::kCannotRun);
}

/// Three levels of one node each, whose points are 100 apart in x; hierarchy as in "COPC Specification 1.0".
struct CopcFile {
    std::string bytes;
    std::size_t info_at = 0, hierarchy_at = 0;

    CopcFile() {
        std::vector<std::string> points;
        for (int level = 0; level < 3; ++level)
            for (int k = 0; k < 10; ++k) {
                std::string point = lasPoint(30, 10000 * level + k, 50, 50, 0);
                points.push_back(point);
            }
        LasSource::Record info;
        info.vlr.user_id = "copc";
        info.vlr.record_id = 1;
        info.data.assign(160, '\0');
        for (std::size_t axis = 0; axis < 3; ++axis) put(info.data, 8 * axis, 200.0);
        put(info.data, 24, 200.0);
        bytes =
            test::writeLas(6, points, true, [&](LasDescription& description) { description.records.push_back(info); });
        const LasFile file = openLas(bytes);
        info_at = static_cast<std::size_t>(findVlr(file, "copc", 1)->data.data() - bytes.data());
        const std::string record(findVlr(file, kLaszipUser, kLaszipRecord)->data);
        put(bytes, bytes.find(record) + 12, ~std::uint32_t{0});
        const std::string variable = bytes.substr(bytes.find("laszip encoded") - 2 + 54, record.size());
        bytes.resize(file.header.point_offset + 8);
        std::vector<std::uint64_t> counts, sizes, places;
        for (std::size_t level = 0; level < 3; ++level) {
            std::string records;
            for (std::size_t k = 0; k < 10; ++k) records += points[10 * level + k];
            const std::string chunk = packChunk(variable, records);
            places.push_back(bytes.size());
            bytes += chunk;
            counts.push_back(10);
            sizes.push_back(chunk.size());
        }
        put(bytes, file.header.point_offset, std::int64_t(bytes.size()));
        bytes += packTable(variable, counts, sizes);
        hierarchy_at = bytes.size();
        const int cells[3] = {0, 0, 2}; // x of the node: 0 to 400, 0 to 200, 200 to 300
        for (std::size_t level = 0; level < 2; ++level)
            addEntry(int(level), cells[level], places[level], sizes[level], 10);
        addEntry(2, 2, bytes.size() + 32, 32, -1); // a separate page
        addEntry(2, 2, places[2], sizes[2], 10);
        put(bytes, info_at + 40, std::uint64_t{hierarchy_at});
        put(bytes, info_at + 48, std::uint64_t{96});
    }
    void addEntry(int level, int x, std::uint64_t at, std::uint64_t size, int count) {
        for (const int number : {level, x, 0, 0}) put(bytes, bytes.size(), number);
        put(bytes, bytes.size(), at);
        put(bytes, bytes.size(), static_cast<std::int32_t>(size));
        put(bytes, bytes.size(), count);
    }
};

struct CopcTest : LasTest {
    void SetUp() override {
        if (!hasLaz()) GTEST_SKIP() << "this build has no LAZ";
    }
    std::size_t pointsRead(const std::string& bytes, const ReadOptions& options) const {
        return read(write("a.copc.laz", bytes), options).points_read;
    }
};

TEST_F(CopcTest, LevelsAndBoundsChooseNodes) {
    const CopcFile copc;
    EXPECT_EQ(pointsRead(copc.bytes, {}), 30u);
    for (int level = 0; level < 3; ++level) {
        ReadOptions options;
        options.level = level;
        EXPECT_EQ(pointsRead(copc.bytes, options), 10u * static_cast<unsigned>(level + 1));
    }
    ReadOptions options;
    options.filter.bounds = Eigen::AlignedBox3d(Vec3d(0, 0, 0), Vec3d(50, 50, 50));
    EXPECT_EQ(pointsRead(copc.bytes, options), 20u) << "the node of level 2 is elsewhere";
    EXPECT_EQ(read(write("a.laz", copc.bytes), options).positions.size(), 10u);
}

TEST_F(LasTest, MissingLevelsAreNoted) {
    LasParts parts;
    parts.points = linePoints(0, 3);
    ReadOptions options;
    options.level = 0;
    for (const std::string& path : {write("a.las", parts.bytes()), write("a.xyz", "0 0 0\n1 0 0\n2 0 0\n")}) {
        const Cloud cloud = read(path, options);
        EXPECT_EQ(cloud.positions.size(), 3u);
        ASSERT_EQ(cloud.notes.size(), 1u) << path;
        EXPECT_HAS(cloud.notes[0].text, "levels of detail");
        EXPECT_TRUE(read(path).notes.empty());
    }
}

TEST_F(CopcTest, InvalidHierarchiesAreRefused) {
    const CopcFile copc;
    ReadOptions options;
    options.level = 5;
    const auto with = [&](std::size_t at, auto number) {
        std::string bytes = copc.bytes;
        put(bytes, at, number);
        return reasonOf(write("a.laz", bytes), options);
    };
    const std::size_t entry = copc.hierarchy_at;
    EXPECT_HAS(with(copc.info_at + 40, ~std::uint64_t{0}), "outside the file");
    EXPECT_HAS(with(copc.info_at + 48, ~std::uint64_t{0}), "outside the file");
    EXPECT_HAS(with(entry + 16, std::uint64_t{1} << 40), "outside the file");
    EXPECT_HAS(with(entry + 24, -1), "outside the file");
    EXPECT_HAS(with(entry, 31), "outside the file");
    EXPECT_HAS(with(entry + 28, 1000), "1020 points*30");
    EXPECT_HAS(with(copc.info_at + 24, 0.0), "size *above 0");
    std::string circle = copc.bytes;
    put(circle, entry + 64 + 16, std::uint64_t{copc.hierarchy_at});
    put(circle, entry + 64 + 24, 96);
    EXPECT_HAS(reasonOf(write("a.laz", circle), options), "cyclic");
    std::string twice = copc.bytes;
    twice.replace(entry + 32 + 16, 8, twice.substr(entry + 16, 8));
    EXPECT_HAS(reasonOf(write("a.laz", twice), options), "overlap");
}

TEST_F(CopcTest, EveryPrefixIsReadOrRefused) {
    const CopcFile copc;
    ReadOptions options;
    options.level = 5;
    for (std::size_t size = 1; size < copc.bytes.size(); ++size) {
        const std::string path = write("a.laz", copc.bytes.substr(0, size));
        for (const ReadOptions& each : {ReadOptions{}, options}) {
            try {
                readInputs({path}, each);
            } catch (const Error& error) {
                ASSERT_EQ(error.code, ExitCode::kBadInput) << error.what();
            }
        }
    }
}

/// Sets each field of headers of every version to 0, 1 and its maximum: read or refused, with little memory.
TEST_F(LasTest, HeaderFieldsAtTheirLimits) {
    struct Field {
        std::size_t at, size;
    };
    std::vector<Field> fields = {{4, 2},   {6, 2},   {24, 1},  {25, 1},  {90, 2},  {92, 2},  {94, 2},  {96, 4},
                                 {100, 4}, {104, 1}, {105, 2}, {107, 4}, {227, 8}, {235, 8}, {243, 4}, {247, 8}};
    for (std::size_t at = 111; at < 131; at += 4) fields.push_back({at, 4}); // points of each return
    for (std::size_t at = 131; at < 227; at += 8) fields.push_back({at, 8}); // scale, offset, bounds
    for (const std::uint8_t format : {0, 7})
        for (const bool packed : {false, true}) {
            if (packed && !hasLaz()) continue;
            const std::string good = test::writeLas(format, linePoints(format, 20), packed);
            for (const auto& [at, size] : fields)
                for (const int value : {0, 1, 255}) {
                    if (at + size > openLas(good).header.header_bytes) continue;
                    std::string bytes = good;
                    for (std::size_t i = 0; i < size; ++i)
                        bytes[at + i] = static_cast<char>(value == 1 ? (i == 0) : value);
                    try {
                        readInputs({write("a.las", bytes)}, {});
                    } catch (const Error& error) {
                        ASSERT_EQ(error.code, ExitCode::kBadInput) << error.what();
                        ASSERT_EQ(std::string(error.what()).find('\n'), std::string::npos);
                    }
                }
        }
}

TEST_F(LasTest, EveryPrefixOfAFileIsRefused) {
    const std::string good = test::writeLas(7, linePoints(7, 5), false);
    readPrefixes("a.las", good);
    if (hasLaz()) readPrefixes("a.laz", test::writeLas(3, linePoints(3, 5), true));
}

TEST_F(LasTest, SuffixesDoNotMatter) {
    LasParts parts;
    parts.points = linePoints(0, 2);
    EXPECT_EQ(read(write("a.ply", parts.bytes())).positions.size(), 2u);
    EXPECT_EQ(read(write("a.laz", parts.bytes())).positions.size(), 2u);
    EXPECT_HAS(reasonOf(write("b.las", "ply\nformat ascii 1.0\nend_header\n")), "b.las");
    parts.points.clear();
    EXPECT_HAS(reasonOf(write("c.las", parts.bytes())), "c.las: *no points");
}

} // namespace
} // namespace pointrt
