// SPDX-License-Identifier: Apache-2.0
// Expected values: pyproj 3.7 (PROJ 9.5), Proj.get_factors and CRS.axis_info.
#include "format/crs/projected_crs.h"

#include <gtest/gtest.h>

#include "tests/support/wkt.h"

namespace pointrt {
namespace {

constexpr double kUsSurveyFoot = 1200.0 / 3937.0;
constexpr double kToleranceDeg = 0.001;

constexpr const char* kOregon =
    R"wkt(PROJCS["NAD83 / Oregon GIC Lambert (ft)",GEOGCS["NAD83",DATUM["North_American_Datum_1983",)wkt"
    R"wkt(SPHEROID["GRS 1980",6378137,298.257222101]],PRIMEM["Greenwich",0],UNIT["degree",0.0174532925199433]],)wkt"
    R"wkt(PROJECTION["Lambert_Conformal_Conic_2SP"],PARAMETER["latitude_of_origin",41.75],)wkt"
    R"wkt(PARAMETER["central_meridian",-120.5],PARAMETER["standard_parallel_1",43],PARAMETER["standard_parallel_2",45.5],)wkt"
    R"wkt(PARAMETER["false_easting",1312335.958],PARAMETER["false_northing",0],UNIT["foot",0.3048]])wkt";

double convergence(std::string_view crs, double latitude_deg, double longitude_deg) {
    return meridianConvergenceDeg(crs, latitude_deg, longitude_deg).value_or(-999);
}

struct ProjectedCrsTest : testing::Test {
    void SetUp() override {
        if (!isProjInstalled())
            GTEST_SKIP()
                << "SKIPPED: PROJ is not installed (Debian, Ubuntu: libproj25): no coordinate system is checked";
    }
};

TEST_F(ProjectedCrsTest, ConvergenceOfUtmZones) {
    EXPECT_NEAR(convergence("EPSG:32632", 48, 11), 1.48656, kToleranceDeg);
    EXPECT_NEAR(convergence("EPSG:32632", 60, 6.5), -2.16541, kToleranceDeg);
    EXPECT_NEAR(convergence("EPSG:32733", -33, 13.5), 0.81709, kToleranceDeg);
    EXPECT_NEAR(convergence(test::kUtm33, 45, 17), 1.41450, kToleranceDeg);
}

TEST_F(ProjectedCrsTest, ConvergenceOfNationalGrids) {
    EXPECT_NEAR(convergence("EPSG:2056", 47.3769, 8.5417), 0.80541, kToleranceDeg); // Swiss LV95
    EXPECT_NEAR(convergence("EPSG:2056", 46.2, 6.15), -0.94245, kToleranceDeg);
    EXPECT_NEAR(convergence("EPSG:27700", 57, -5), -2.51670, kToleranceDeg);
    EXPECT_NEAR(convergence("EPSG:2154", 48, 7.5), 3.26523, kToleranceDeg);
    EXPECT_NEAR(convergence("EPSG:28992", 52.37, 4.9), -0.38564, kToleranceDeg);
    EXPECT_NEAR(convergence("EPSG:2193", -41, 175), -1.31243, kToleranceDeg); // axes: northing, easting
    EXPECT_NEAR(convergence("EPSG:5070", 40, -120), -14.46967, kToleranceDeg);
    EXPECT_NEAR(convergence("EPSG:3857", 50, 40), 0, kToleranceDeg);
}

TEST_F(ProjectedCrsTest, ConvergenceOfStatePlanesInFeet) {
    EXPECT_NEAR(convergence("EPSG:2225", 40.8, -124), -1.30777, kToleranceDeg);
    EXPECT_NEAR(convergence("EPSG:2277", 30.27, -97.74), 1.33572, kToleranceDeg);
    EXPECT_NEAR(convergence(kOregon, 44.058, -123.068), -1.79207, kToleranceDeg);
}

/// Expected places: the definition of each grid's origin, and pyproj 3.7.
TEST_F(ProjectedCrsTest, PlacesOnTheEarth) {
    const auto expectPlace = [](std::string_view crs, double easting, double northing, double latitude,
                                double longitude) {
        const auto place = geographicPlace(crs, easting, northing);
        ASSERT_TRUE(place) << crs;
        EXPECT_NEAR(place->latitude_deg, latitude, 0.002) << crs; // 200 m: without grids of datum shifts
        EXPECT_NEAR(place->longitude_deg, longitude, 0.002) << crs;
    };
    expectPlace("EPSG:2056", 2600000, 1200000, 46.9511, 7.4386); // Bern's old observatory
    expectPlace("EPSG:32632", 500000, 0, 0, 9);                  // central meridian and equator
    expectPlace("EPSG:2193", 1600000, 10000000, 0, 173);         // axes: northing, easting
    expectPlace("EPSG:27572", 600000, 2200000, 46.8, 2.33723);   // counts from Paris, in grads
    expectPlace(kOregon, 637000, 852000, 44.0583, -123.0697);    // Autzen Stadium, in feet
    EXPECT_FALSE(geographicPlace("EPSG:4326", 8, 47)) << "not projected";
    EXPECT_FALSE(geographicPlace("EPSG:32632", 1e30, 0)) << "not on the Earth";
}

TEST_F(ProjectedCrsTest, LongitudesCountFromGreenwich) {
    // Lambert zone II counts from Paris, 2.33723 degrees east: (2.35 - 2.33723) * sin(46.8 degrees)
    EXPECT_NEAR(convergence("EPSG:27572", 48.85, 2.35), 0.00931, kToleranceDeg);
}

TEST_F(ProjectedCrsTest, CompoundSystemsGiveTheirHorizontalPart) {
    const std::string both =
        "COMPD_CS[\"both\"," + std::string(kOregon) + R"(,VERT_CS["height",VERT_DATUM["datum",2005],UNIT["metre",1]]])";
    EXPECT_NEAR(convergence(both, 44.058, -123.068), -1.79207, kToleranceDeg);
    EXPECT_DOUBLE_EQ(projectedCrs(both).value().metres_per_unit, 0.3048);
    EXPECT_EQ(projectedCrs("EPSG:5555").value().name, "ETRS89 / UTM zone 32N"); // with heights
}

TEST_F(ProjectedCrsTest, NameUnitAndAreaOfUse) {
    const ProjectedCrs swiss = projectedCrs("EPSG:2056").value();
    EXPECT_EQ(swiss.name, "CH1903+ / LV95");
    EXPECT_EQ(swiss.metres_per_unit, 1);
    ASSERT_TRUE(swiss.area_of_use);
    EXPECT_NEAR(swiss.area_of_use->west_deg, 5.96, 0.02);
    EXPECT_NEAR(swiss.area_of_use->south_deg, 45.82, 0.02);
    EXPECT_NEAR(swiss.area_of_use->east_deg, 10.49, 0.02);
    EXPECT_NEAR(swiss.area_of_use->north_deg, 47.81, 0.02);
    EXPECT_NEAR(projectedCrs("EPSG:2225").value().metres_per_unit, kUsSurveyFoot, 1e-12);
    EXPECT_DOUBLE_EQ(projectedCrs(kOregon).value().metres_per_unit, 0.3048);
    EXPECT_FALSE(projectedCrs(kOregon).value().area_of_use);
    EXPECT_TRUE(projectedCrs(test::kUtm33).value().area_of_use); // by its ID
}

TEST_F(ProjectedCrsTest, OtherTextsHaveNoProjection) {
    for (const std::string text :
         {"", "EPSG:", "EPSG:4326", "EPSG:-1", "EPSG:99999999", "EPSG:2056x", "PROJCS[[[[(((",
          "+proj=utm +zone=33 +type=crs", R"(GEOGCS["WGS 84",UNIT["degree",0.0174532925199433]])"}) {
        EXPECT_FALSE(projectedCrs(text)) << text;
        EXPECT_FALSE(meridianConvergenceDeg(text, 47, 8)) << text;
    }
    EXPECT_FALSE(projectedCrs(std::string(70000, '[')));
}

} // namespace
} // namespace pointrt
