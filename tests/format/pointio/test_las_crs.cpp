// SPDX-License-Identifier: Apache-2.0
#include "format/pointio/las_crs.h"

#include <gtest/gtest.h>

#include "format/crs/projected_crs.h"
#include "tests/support/las_file.h"

namespace pointrt {
namespace {

using Kind = LasCrs::Kind;

struct Key {
    std::uint16_t key, place, count, value;
};

LasCrs ofKeys(const std::vector<Key>& keys, const std::vector<double>& doubles = {}) {
    std::string directory, reals;
    for (const std::uint16_t word : {1, 1, 0, int(keys.size())}) test::put(directory, directory.size(), word);
    for (const Key& key : keys)
        for (const std::uint16_t word : {key.key, key.place, key.count, key.value})
            test::put(directory, directory.size(), word);
    for (const double number : doubles) test::put(reals, reals.size(), number);
    test::LasParts parts;
    parts.points = {test::lasPoint(20, 0, 0, 0, 0)};
    parts.records = {test::lasRecord("LASF_Projection", 34735, directory),
                     test::lasRecord("LASF_Projection", 34736, reals)};
    const std::string bytes = parts.bytes();
    return lasCrs(openLas(bytes));
}

constexpr double kUsFoot = 1200.0 / 3937.0;

TEST(LasCrs, GeoTiffKeys) {
    LasCrs crs = ofKeys({{1024, 0, 1, 1}, {3072, 0, 1, 32610}});
    EXPECT_EQ(crs.kind, Kind::kProjected);
    EXPECT_EQ(crs.name, "EPSG:32610");
    EXPECT_EQ(crs.metres_per_unit, 1);
    crs = ofKeys({{1024, 0, 1, 1}, {3072, 0, 1, 2994}, {3076, 0, 1, 9003}});
    EXPECT_EQ(crs.name, "EPSG:2994");
    EXPECT_DOUBLE_EQ(crs.metres_per_unit, kUsFoot);
    crs = ofKeys({{1024, 0, 1, 1}, {3072, 0, 1, 32767}, {3076, 0, 1, 32767}, {3077, 34736, 1, 1}}, {7, 0.3048});
    EXPECT_EQ(crs.name, "");
    EXPECT_DOUBLE_EQ(crs.metres_per_unit, 0.3048);
    crs = ofKeys({{1024, 0, 1, 2}, {2048, 0, 1, 4326}});
    EXPECT_EQ(crs.kind, Kind::kGeographic);
    EXPECT_EQ(crs.name, "EPSG:4326");
    EXPECT_EQ(crs.metres_per_unit, 0);
    EXPECT_EQ(ofKeys({{1024, 0, 1, 3}, {2048, 0, 1, 4978}}).kind, Kind::kGeocentric);
    EXPECT_EQ(ofKeys({}).kind, Kind::kUnknown);
    constexpr std::uint16_t kBeyondTheDoubles = 65535;
    EXPECT_EQ(ofKeys({{3076, 0, 1, 32767}, {3077, 34736, 1, kBeyondTheDoubles}, {3072, 0, 1, 2994}}).metres_per_unit,
              0);
}

TEST(LasCrs, KeysWithoutAUnitTakeThatOfTheSystem) {
    EXPECT_EQ(ofKeys({{3072, 0, 1, 25832}}).metres_per_unit, 1); // common systems are known without PROJ
    if (!isProjInstalled())
        GTEST_SKIP()
            << "SKIPPED: PROJ is not installed (Debian, Ubuntu: libproj25): units of EPSG codes are not checked";
    EXPECT_EQ(ofKeys({{3072, 0, 1, 2056}}).metres_per_unit, 1);
    EXPECT_NEAR(ofKeys({{3072, 0, 1, 2225}}).metres_per_unit, kUsFoot, 1e-12);
    EXPECT_EQ(ofKeys({{3072, 0, 1, 60000}}).metres_per_unit, 0);
}

TEST(LasCrs, Wkt) {
    const std::string projected = R"(PROJCS["NAD83 / x, y",GEOGCS["NAD83",DATUM["d",SPHEROID["s",6378137,298]],)"
                                  R"(PRIMEM["Greenwich",0],UNIT["degree",0.0174532925]],PROJECTION["Lambert"],)"
                                  R"(UNIT["US survey foot",0.304800609601219,AUTHORITY["EPSG","9003"]]])";
    EXPECT_EQ(crsOfWkt(projected).kind, Kind::kProjected);
    EXPECT_DOUBLE_EQ(crsOfWkt(projected).metres_per_unit, 0.304800609601219);
    const std::string compound =
        "COMPD_CS[\"both\"," + projected + R"(,VERT_CS["v",VERT_DATUM["d",2005],UNIT["metre",1]]])";
    EXPECT_DOUBLE_EQ(crsOfWkt(compound).metres_per_unit, 0.304800609601219);
    EXPECT_EQ(crsOfWkt(compound).name, compound);
    const std::string second = R"(PROJCRS["u",BASEGEOGCRS["w",ANGLEUNIT["degree",0.017]],CONVERSION["c"],)"
                               R"(CS[Cartesian,2],AXIS["easting",east,LENGTHUNIT["metre",1]]])";
    EXPECT_EQ(crsOfWkt(second).metres_per_unit, 1);
    EXPECT_EQ(crsOfWkt(R"(GEOGCS["w",UNIT["degree",0.017]])").kind, Kind::kGeographic);
    EXPECT_EQ(crsOfWkt(R"(GEOCCS["w",UNIT["metre",1]])").kind, Kind::kGeocentric);
}

/// Other text, unbalanced brackets, and very deep nesting.
TEST(LasCrs, MalformedWkt) {
    for (const std::string text : {"", "]", "[[[", "PROJCS", "PROJCS[", "PROJCS[UNIT[", "PROJCS[UNIT[]]",
                                   "PROJCS[UNIT[,]]", "PROJCS[UNIT[\",\"]]", "PROJCS[UNIT[\"x\",-1]]", "\"PROJCS[]"})
        EXPECT_EQ(crsOfWkt(text).metres_per_unit, 0) << text;
    std::string deep;
    for (int i = 0; i < 7000; ++i) deep += "COMPD_CS[";
    deep += "PROJCS[]" + std::string(7000, ']');
    EXPECT_EQ(crsOfWkt(deep).kind, Kind::kUnknown);
}

} // namespace
} // namespace pointrt
