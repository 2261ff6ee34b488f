// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "format/pointio/e57.h"
#include "preprocess/ingest/formats.h"
#include "preprocess/ingest/scalar.h"
#include "tests/preprocess/input/input_fixture.h"
#include "tests/preprocess/input/points/e57_file.h"
#include "tests/support/find_attribute.h"

namespace pointrt {
namespace {

using namespace test;

class E57Test : public InputTest {
protected:
    void SetUp() override {
        if (!hasE57()) GTEST_SKIP() << "this build has no Rust: E57 is not tested";
    }

    Cloud readScans(const std::vector<E57TestScan>& scans, const std::string& root_xml = "") const {
        return readText("a.e57", e57File(scans, root_xml));
    }
    std::string reasonOfScans(const std::vector<E57TestScan>& scans, const std::string& root_xml = "") const {
        return reasonOfText("a.e57", e57File(scans, root_xml));
    }
};

/// Columns: three coordinates, and others.
std::vector<E57TestColumn> at(const std::vector<double>& x, const std::vector<double>& y, const std::vector<double>& z,
                              const std::vector<E57TestColumn>& others = {}) {
    std::vector<E57TestColumn> columns{e57Doubles("cartesianX", x), e57Doubles("cartesianY", y),
                                       e57Doubles("cartesianZ", z)};
    columns.insert(columns.end(), others.begin(), others.end());
    return columns;
}

/// Two points with further columns.
std::vector<E57TestColumn> two(const std::vector<E57TestColumn>& others = {}) {
    return at({1, 4}, {2, 5}, {3, 6}, others);
}

std::string poseXml(std::array<double, 4> rotation, const Vec3d& translation) {
    std::string xml = "<pose type=\"Structure\"><rotation type=\"Structure\">";
    for (std::size_t i = 0; i < 4; ++i) xml += e57Number(std::string(1, "wxyz"[i]), rotation[i]);
    xml += "</rotation><translation type=\"Structure\">";
    for (int i = 0; i < 3; ++i) xml += e57Number(std::string(1, "xyz"[i]), translation[i]);
    return xml + "</translation></pose>";
}

/// A quarter rotation about z: x becomes y.
const std::array<double, 4> kQuarter = {std::numbers::sqrt2 / 2, 0, 0, std::numbers::sqrt2 / 2};

void expectWorld(const Cloud& cloud, const std::vector<Vec3d>& wanted) {
    ASSERT_EQ(cloud.positions.size(), wanted.size());
    for (std::size_t i = 0; i < wanted.size(); ++i) EXPECT_LT((world(cloud, i) - wanted[i]).norm(), 1e-6) << i;
}

std::string limitsXml(double most) {
    std::string xml = "<colorLimits type=\"Structure\">";
    for (const char* color : {"Red", "Green", "Blue"})
        xml +=
            e57Number(fmt::format("color{}Minimum", color), 0) + e57Number(fmt::format("color{}Maximum", color), most);
    return xml + "</colorLimits>";
}

std::vector<E57TestColumn> colors(std::int64_t most, const std::vector<std::int64_t>& values) {
    return {e57Whole("colorRed", 0, most, values), e57Whole("colorGreen", 0, most, values),
            e57Whole("colorBlue", 0, most, values)};
}

TEST_F(E57Test, CoordinatesOfAllKindsAreExact) {
    const Cloud doubles = readScans({{at({1.5, -4}, {2, 5}, {3, 1e6})}});
    expectWorld(doubles, {{1.5, 2, 3}, {-4, 5, 1e6}});
    EXPECT_TRUE(doubles.attributes.empty());
    EXPECT_TRUE(doubles.colors.empty());
    const Cloud floats = readScans(
        {{{e57Floats("cartesianX", {1.5f}), e57Floats("cartesianY", {-2}), e57Floats("cartesianZ", {0.25f})}}});
    expectWorld(floats, {{1.5, -2, 0.25}});
    const Cloud scaled =
        readScans({{{e57Scaled("cartesianX", -9, 1 << 20, 0.25, 1000, {4, -9}),
                     e57Scaled("cartesianY", 0, 100, 0.5, 0, {3, 100}), e57Whole("cartesianZ", 7, 7, {7, 7})}}});
    expectWorld(scaled, {{1001, 1.5, 7}, {997.75, 50, 7}});
}

TEST_F(E57Test, WholeNumbersOfAnyWidthSurvivePackets) {
    std::mt19937_64 random(1);
    constexpr std::size_t kPoints = 1000;
    const std::vector<double> zeros(kPoints);
    E57TestScan scan{at(zeros, zeros, zeros)};
    std::vector<std::pair<std::string, std::vector<std::int64_t>>> wanted;
    for (const int bits : {1, 3, 8, 13, 31, 33, 56, 57, 58, 63, 64}) {
        const std::uint64_t range = ~std::uint64_t{0} >> (64 - bits);
        const std::int64_t least = bits == 64 ? std::numeric_limits<std::int64_t>::min() : -5;
        std::vector<std::int64_t> values;
        for (std::size_t i = 0; i < kPoints; ++i)
            values.push_back(static_cast<std::int64_t>(static_cast<std::uint64_t>(least) + (random() & range)));
        const auto most = static_cast<std::int64_t>(static_cast<std::uint64_t>(least) + range);
        wanted.emplace_back(fmt::format("w{}", bits), values);
        scan.columns.push_back(e57Whole("las:" + wanted.back().first, least, most, values));
    }
    for (const std::size_t packets : {3, 7, 40}) { // one holds 64 KiB
        scan.packets = packets;
        scan.other_packets = packets == 7;
        const Cloud cloud = readScans({scan});
        for (const auto& [name, values] : wanted) {
            const Attribute* const attribute = findAttribute(cloud, name);
            ASSERT_TRUE(attribute) << name;
            for (std::size_t i = 0; i < cloud.positions.size(); ++i)
                ASSERT_EQ(static_cast<std::int64_t>(
                              loadWhole(attribute->values.data() + i * scalarSize(attribute->type), attribute->type)),
                          values[i])
                    << name << ' ' << i;
        }
    }
}

TEST_F(E57Test, ScansAreTransformedByTheirPoses) {
    const std::string first = e57Text("name", "hall") + poseXml({1, 0, 0, 0}, {10, 0, 0});
    const std::string second = e57Text("name", "stairs") + poseXml(kQuarter, {0, 0, 5});
    const Cloud cloud = readScans({{two(), first}, {at({1}, {0}, {0}), second}});
    expectWorld(cloud, {{11, 2, 3}, {14, 5, 6}, {0, 1, 5}});
    ASSERT_EQ(cloud.scans.size(), 2u);
    EXPECT_TRUE(cloud.scans[0].name.ends_with("a.e57: hall"));
    EXPECT_TRUE(cloud.scans[1].name.ends_with("a.e57: stairs"));
    EXPECT_EQ(cloud.scans[0].sensor, Vec3d(10, 0, 0));
    EXPECT_EQ(cloud.scans[1].sensor, Vec3d(0, 0, 5));
    EXPECT_EQ(numbersOf(cloud, "scan"), (std::vector<double>{0, 0, 1}));
    EXPECT_EQ(cloud.world.up, Vec3d(0, 0, 1));
    EXPECT_EQ(cloud.world.metres_per_unit, 1);
}

TEST_F(E57Test, AnIdentityPoseIsNotAScannerPosition) {
    EXPECT_FALSE(readScans({{two()}}).scans[0].sensor);
    const std::string nothing = poseXml({1, 0, 0, 0}, {0, 0, 0});
    EXPECT_FALSE(readScans({{two(), nothing}}).scans[0].sensor);
    // a grid of rows and columns is in the scanner's frame
    const std::vector<E57TestColumn> grid{e57Whole("rowIndex", 0, 9, {1, 2}),
                                          e57Whole("columnIndex", 0, 900, {3, 300})};
    const Cloud gridded = readScans({{two(grid), nothing}});
    EXPECT_EQ(gridded.scans[0].sensor, Vec3d(0, 0, 0));
    EXPECT_EQ(numbersOf(gridded, "row"), (std::vector<double>{1, 2}));
    EXPECT_EQ(numbersOf(gridded, "column"), (std::vector<double>{3, 300}));
}

TEST_F(E57Test, SphericalCoordinatesAreConverted) {
    const double pi = std::numbers::pi;
    const E57TestScan scan{{e57Doubles("sphericalRange", {2, 2, 3}), e57Doubles("sphericalAzimuth", {0, pi / 2, 1}),
                            e57Doubles("sphericalElevation", {0, 0, pi / 2})},
                           poseXml({1, 0, 0, 0}, {100, 0, 0})};
    const Cloud cloud = readScans({scan});
    expectWorld(cloud, {{102, 0, 0}, {100, 2, 0}, {100, 0, 3}});
    EXPECT_EQ(cloud.scans[0].sensor, Vec3d(100, 0, 0));
}

TEST_F(E57Test, InvalidPointsAreDroppedAndCounted) {
    const E57TestColumn state = e57Whole("cartesianInvalidState", 0, 2, {0, 1, 2, 0});
    const Cloud cartesian = readScans({{at({1, 2, 3, 4, 5}, {0, 0, 0, 0, 0}, {0, 0, 0, 0, 0},
                                           {e57Whole("cartesianInvalidState", 0, 2, {0, 1, 2, 0, 2})})}});
    expectWorld(cartesian, {{1, 0, 0}, {4, 0, 0}});
    EXPECT_EQ(cartesian.points_read, 5u);
    EXPECT_EQ(cartesian.points_non_finite, 3u);
    ASSERT_EQ(cartesian.notes.size(), 1u);
    EXPECT_HAS(cartesian.notes[0].text, "3 of its 5 points *invalid *1 *direction");
    // if both kinds are present, the valid one is used
    const Cloud both = readScans({{at(
        {1, 2, 3, 4}, {0, 0, 0, 0}, {0, 0, 0, 0},
        {state, e57Doubles("sphericalRange", {9, 8, 7, 6}), e57Doubles("sphericalAzimuth", {0, 0, 0, 0}),
         e57Doubles("sphericalElevation", {0, 0, 0, 0}), e57Whole("sphericalInvalidState", 0, 2, {0, 0, 1, 2})})}});
    expectWorld(both, {{1, 0, 0}, {8, 0, 0}, {4, 0, 0}});
    EXPECT_HAS(both.notes.at(0).text, "1 of its 4 points *invalid *1 ");
    const E57TestColumn none = e57Whole("cartesianInvalidState", 0, 2, {2, 2});
    EXPECT_HAS(reasonOfScans({{two({none})}}), "2 points *invalid");
}

TEST_F(E57Test, ColoursAreScaledByTheirLimits) {
    const Rgb8 black{0, 0, 0}, white{255, 255, 255};
    const Cloud bytes = readScans({{two(colors(255, {0, 255})), limitsXml(255)}});
    EXPECT_EQ(bytes.colors, (std::vector{black, white}));
    EXPECT_FALSE(findAttribute(bytes, "rgb16"));
    for (const std::int64_t most : {1023, 4095, 65535}) {
        const Cloud wide = readScans({{two(colors(most, {most / 2, most})), limitsXml(static_cast<double>(most))}});
        const double half = std::round(65535.0 * static_cast<double>(most / 2) / static_cast<double>(most));
        EXPECT_EQ(numbersOf(wide, "rgb16"), (std::vector<double>{half, half, half, 65535, 65535, 65535})) << most;
        EXPECT_EQ(wide.colors, (std::vector{Rgb8{127, 127, 127}, white})) << most;
    }
    // a dark scan stays dark; the limits of the column's type are used as well
    EXPECT_EQ(readScans({{two(colors(4095, {0, 40}))}}).colors, (std::vector{black, Rgb8{2, 2, 2}}));
    const std::vector<E57TestColumn> real{e57Floats("colorRed", {0, 1}), e57Floats("colorGreen", {0.5, 1}),
                                          e57Floats("colorBlue", {2, -1})};
    const Cloud reals = readScans({{two(real), limitsXml(1)}});
    EXPECT_EQ(reals.colors, (std::vector{Rgb8{0, 128, 255}, Rgb8{255, 255, 0}}));
    EXPECT_HAS(reals.notes.at(0).text, "2 *colour values *limits");
}

TEST_F(E57Test, RealColoursWithoutLimitsAreScaledByTheirValues) {
    const std::vector<E57TestColumn> shares{e57Floats("colorRed", {0, 1}), e57Floats("colorGreen", {0, 1}),
                                            e57Floats("colorBlue", {0, 0.5})};
    EXPECT_EQ(readScans({{two(shares)}}).colors[1], (Rgb8{255, 255, 128}));
    EXPECT_EQ(readScans({{two(shares), limitsXml(0)}}).colors[1], (Rgb8{255, 255, 128})); // empty limits are ignored
}

TEST_F(E57Test, PointsWithoutColourAreGrey) {
    std::vector<E57TestColumn> columns = colors(255, {9, 9});
    columns.push_back(e57Whole("isColorInvalid", 0, 1, {0, 1}));
    const Cloud cloud = readScans({{two(columns)}});
    EXPECT_EQ(cloud.colors, (std::vector{Rgb8{9, 9, 9}, Rgb8{200, 200, 200}}));
    EXPECT_HAS(cloud.notes.at(0).text, "1 of its colours ");
}

TEST_F(E57Test, AttributesKeepTheirValuesAndTypes) {
    const std::vector<E57TestColumn> columns{
        e57Whole("intensity", 0, 4000, {7, 4000}),        e57Whole("isIntensityInvalid", 0, 1, {0, 0}),
        e57Whole("returnIndex", 0, 255, {0, 255}),        e57Whole("returnCount", 1, 300, {1, 300}),
        e57Doubles("timeStamp", {0.125, 1e-9}),           e57Whole("isTimeStampInvalid", 0, 1, {0, 1}),
        e57Whole("las:pointSourceId", 0, 65535, {1, 2}),  e57Floats("las:weather", {0.1f, 7}),
        e57Scaled("las:range", 0, 1000, 0.1, 0, {3, 30}), e57Scaled("las:halves", 0, 9, 0.5, 0, {3, 4})};
    const Cloud cloud = readScans({{two(columns)}});
    EXPECT_EQ(findAttribute(cloud, "intensity")->type, Scalar::kU16);
    EXPECT_EQ(numbersOf(cloud, "intensity"), (std::vector<double>{7, 4000}));
    EXPECT_EQ(findAttribute(cloud, "return_number")->type, Scalar::kU16);
    EXPECT_EQ(numbersOf(cloud, "return_number"), (std::vector<double>{1, 256}));
    EXPECT_EQ(findAttribute(cloud, "number_of_returns")->type, Scalar::kU16);
    EXPECT_EQ(numbersOf(cloud, "number_of_returns"), (std::vector<double>{1, 300}));
    EXPECT_EQ(numbersOf(cloud, "time_stamp")[0], 0.125);
    EXPECT_TRUE(std::isnan(numbersOf(cloud, "time_stamp")[1]));
    EXPECT_EQ(numbersOf(cloud, "point_source_id"), (std::vector<double>{1, 2}));
    EXPECT_EQ(findAttribute(cloud, "weather")->type, Scalar::kF32);
    EXPECT_EQ(numbersOf(cloud, "weather"), (std::vector<double>{0.1f, 7}));
    EXPECT_EQ(numbersOf(cloud, "range"), (std::vector<double>{3 * 0.1, 30 * 0.1}));
    EXPECT_EQ(findAttribute(cloud, "halves")->type, Scalar::kF32);
    EXPECT_EQ(cloud.attributes.size(), 8u);
    EXPECT_HAS(cloud.notes.at(0).text, "1 of its intensities ");
}

TEST_F(E57Test, ReturnsStartWithOneInEveryFile) {
    const auto read_returns = [&](std::int64_t first, std::int64_t second) {
        return numbersOf(
            readScans({{two({e57Whole("returnIndex", 0, 9, {first, second}), e57Whole("returnCount", 0, 9, {1, 3})})}}),
            "return_number");
    };
    EXPECT_EQ(read_returns(0, 2), (std::vector<double>{1, 3}));
    EXPECT_EQ(read_returns(1, 2), (std::vector<double>{1, 2})); // 1 of 1, as in LAS
}

TEST_F(E57Test, NormalsOfTheExtensionRotateWithTheScan) {
    const std::vector<E57TestColumn> normals{e57Floats("nor:normalX", {1, 0}), e57Floats("nor:normalY", {0, 1}),
                                             e57Floats("nor:normalZ", {0, 0})};
    const Cloud cloud = readScans({{two(normals), poseXml(kQuarter, {0, 0, 0})}});
    ASSERT_EQ(cloud.normals.size(), 2u);
    EXPECT_LT((cloud.normals[0] - Vec3f(0, 1, 0)).norm(), 1e-6f);
    EXPECT_LT((cloud.normals[1] - Vec3f(-1, 0, 0)).norm(), 1e-6f);
    EXPECT_TRUE(cloud.attributes.empty());
}

TEST_F(E57Test, OnlyCoordinateSystemsAreKept) {
    const std::string wkt = "PROJCS[&quot;here&quot;]";
    EXPECT_EQ(readScans({{two()}}, e57Text("coordinateMetadata", "\n " + wkt + " ")).world.crs, "PROJCS[\"here\"]");
    const Cloud other = readScans({{two()}}, e57Text("coordinateMetadata", "somewhere"));
    EXPECT_EQ(other.world.crs, "");
    EXPECT_HAS(other.notes.at(0).text, "coordinate system *'somewhere'");
}

TEST_F(E57Test, ScansMayBeEmptyUnlessAllAre) {
    const E57TestScan empty{at({}, {}, {})};
    const Cloud cloud = readScans({empty, {two()}, empty});
    EXPECT_EQ(cloud.positions.size(), 2u);
    EXPECT_EQ(cloud.scans.size(), 3u);
    EXPECT_HAS(reasonOfScans({empty, empty}), "no points");
    EXPECT_HAS(reasonOfScans({}), "no scans");
}

TEST_F(E57Test, ProgressIsOfAllScans) {
    std::vector<double> shares;
    const auto path = write("a.e57", e57File({{two()}, {at({}, {}, {})}, {two()}}));
    readInputs({path}, {}, [&](const ReadStatus& status) { shares.push_back(status.share); });
    EXPECT_EQ(shares, (std::vector<double>{0, 0.5, 1}));
}

TEST_F(E57Test, MessagesNameTheScan) {
    const E57TestColumn other = e57Doubles("las:height", {1, 2});
    EXPECT_HAS(reasonOfScans({{two()}, {{other}}}), "a.e57:scan 2: *coordinates");
    EXPECT_HAS(reasonOfScans({{{other}, e57Text("name", "top")}}), "a.e57:'top': *coordinates");
    EXPECT_HAS(reasonOfScans({{two({other, other})}}), "two columns 'las:height'");
    EXPECT_HAS(reasonOfScans({{two(), poseXml({0, 0, 0, 0}, {0, 0, 0})}}), "pose *rotation");
    E57TestColumn beyond = e57Whole("las:height", 0, 5, {1, 5});
    beyond.values[1] = 7; // fits in the column's bits, but not in its limits
    EXPECT_HAS(reasonOfScans({{two({beyond})}}), "las:height *maximum");
}

TEST_F(E57Test, WrongChecksumsAreRefused) {
    const std::string bytes =
        e57File({{at(std::vector<double>(200), std::vector<double>(200), std::vector<double>(200))}});
    for (std::size_t page = 0; page < bytes.size() / 1024; ++page) {
        std::string changed = bytes;
        changed[page * 1024 + 600] = static_cast<char>(changed[page * 1024 + 600] ^ 1);
        EXPECT_HAS(reasonOfText("a.e57", changed), "checksum");
    }
}

TEST_F(E57Test, CountsBeyondTheDataAreRefused) {
    for (const char* points : {"3", "1000000", "4000000000", "18446744073709551615"}) {
        E57TestScan scan{two()};
        scan.points = points;
        const std::string reason = reasonOfScans({scan});
        EXPECT_TRUE(reason.find("cut short: 2 of 3") != reason.npos || reason.find("promises") != reason.npos)
            << reason;
    }
    // constant columns take no bits
    E57TestScan nothing{
        {e57Whole("cartesianX", 1, 1, {1}), e57Whole("cartesianY", 2, 2, {2}), e57Whole("cartesianZ", 3, 3, {3})}};
    expectWorld(readScans({nothing}), {{1, 2, 3}});
    nothing.points = "4000000000";
    EXPECT_HAS(reasonOfScans({nothing}), "promises 4000000000 points");
    // scans that share bytes
    const std::vector<double> many(100);
    std::vector<E57TestScan> scans{{at(many, many, many)}};
    for (int i = 0; i < 100; ++i) {
        scans.push_back({at({}, {}, {})});
        scans.back().points = "100";
        scans.back().file_offset = "48";
    }
    EXPECT_HAS(reasonOfScans(scans), "promises 10100 points");
}

TEST_F(E57Test, MaliciousXmlTakesNoTime) {
    std::string deep, tag = "<a", spaces;
    for (int i = 0; i < 300'000; ++i) {
        deep += "<a>";
        tag += fmt::format(" a{}='>'", i);
    }
    for (int i = 0; i < 60'000; ++i) spaces += fmt::format("<a xmlns:a{}='b{}'>", i, i);
    EXPECT_HAS(reasonOfScans({{two()}}, deep), "256 elements");
    EXPECT_HAS(reasonOfScans({{two()}}, tag + "/>"), "4096 bytes");
    EXPECT_HAS(reasonOfScans({{two()}}, spaces), "256 namespaces");
    // comments and text may be long
    const std::string text(100'000, 'x');
    EXPECT_EQ(
        readScans({{two()}}, "<!-- <" + text + "--><a><![CDATA[<" + text + "]]>" + text + "</a>").positions.size(), 2u);
}

/// A valid file that uses every feature.
std::string rich() {
    const E57TestColumn state = e57Whole("cartesianInvalidState", 0, 2, {0, 1});
    const E57TestScan first{two({state, e57Whole("intensity", 0, 4000, {7, 4000}), e57Floats("colorRed", {0, 1}),
                                 e57Floats("colorGreen", {0, 1}), e57Floats("colorBlue", {0, 1})}),
                            poseXml(kQuarter, {1, 2, 3}) + limitsXml(1), "", 2, true};
    return e57Logical({first, {at({1}, {2}, {3})}});
}

/// Reads the file, or expects a one-line refusal.
void readOrRefuse(const std::string& bytes) {
    const InputFile input{"a.e57", bytes, {}};
    Cloud cloud;
    Sink sink(cloud);
    try {
        readers::kE57.read(input, sink);
    } catch (const Error& error) {
        ASSERT_EQ(error.code, ExitCode::kBadInput) << error.what();
        ASSERT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
    }
}

TEST_F(E57Test, EveryPrefixIsReadOrRefused) {
    const std::string bytes = e57Pages(rich());
    for (std::size_t size = 8; size < bytes.size(); ++size) {
        Cloud cloud;
        Sink sink(cloud);
        EXPECT_THROW(readers::kE57.read({"a.e57", bytes.substr(0, size), {}}, sink), Error) << size;
    }
    EXPECT_EQ(readText("a.e57", bytes).positions.size(), 2u);
}

TEST_F(E57Test, HeaderFieldsWithAnyValue) {
    const std::string logical = rich();
    const std::size_t section = 48;
    for (const std::size_t field : {std::size_t{8}, std::size_t{16}, std::size_t{24}, std::size_t{32}, std::size_t{40},
                                    section, section + 8, section + 16, section + 24, section + 32, section + 64})
        for (const std::uint64_t value : {std::uint64_t{0}, std::uint64_t{1}, ~std::uint64_t{0}, std::uint64_t{1} << 31,
                                          std::uint64_t{1} << 63, std::uint64_t{1020}, std::uint64_t{1023}}) {
            std::string changed = logical;
            changed.replace(field, 8, bytesOf(value));
            readOrRefuse(e57Pages(changed));
        }
}

TEST_F(E57Test, BytesWithAnyValue) {
    const std::string logical = rich();
    for (std::size_t i = 8; i < logical.size(); ++i)
        for (const char byte : {'\0', '\1', '\xff', '9', '<', '"', ' '}) {
            std::string changed = logical;
            changed[i] = byte;
            readOrRefuse(e57Pages(changed));
        }
}

TEST_F(E57Test, PiecesMayBeMissing) {
    const std::string logical = rich();
    for (std::size_t i = 48; i < logical.size(); i += 5)
        for (std::size_t size = 1; size < 60; size += 7) {
            std::string changed = logical;
            changed.erase(i, size);
            readOrRefuse(e57Pages(changed));
        }
}

} // namespace
} // namespace pointrt
