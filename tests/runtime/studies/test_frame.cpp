// SPDX-License-Identifier: Apache-2.0
// Where north is: convergences of meridians as PROJ has them (pyproj 3.7, Proj.get_factors), and what files say.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "pointrt/studies.hpp"
#include "runtime/studies/meridians.h"
#include "scene_builder.h"
#include "tests/support/temporary_folder.h"

namespace pointrt {
namespace {

constexpr const char* kOregon =
    R"wkt(PROJCS["NAD83 / Oregon GIC Lambert (ft)",GEOGCS["NAD83",DATUM["North_American_Datum_1983",)wkt"
    R"wkt(SPHEROID["GRS 1980",6378137,298.257222101]],PRIMEM["Greenwich",0],UNIT["degree",0.0174532925199433]],)wkt"
    R"wkt(PROJECTION["Lambert_Conformal_Conic_2SP"],PARAMETER["latitude_of_origin",41.75],)wkt"
    R"wkt(PARAMETER["central_meridian",-120.5],PARAMETER["standard_parallel_1",43],PARAMETER["standard_parallel_2",45.5],)wkt"
    R"wkt(PARAMETER["false_easting",1312335.958],PARAMETER["false_northing",0],UNIT["foot",0.3048]])wkt";
constexpr const char* kUtm33 =
    R"wkt(PROJCRS["WGS 84 / UTM zone 33N",BASEGEOGCRS["WGS 84",DATUM["World Geodetic System 1984",)wkt"
    R"wkt(ELLIPSOID["WGS 84",6378137,298.257223563,LENGTHUNIT["metre",1]]],)wkt"
    R"wkt(PRIMEM["Greenwich",0,ANGLEUNIT["degree",0.0174532925199433]]],CONVERSION["UTM zone 33N",)wkt"
    R"wkt(METHOD["Transverse Mercator",ID["EPSG",9807]],PARAMETER["Latitude of natural origin",0,)wkt"
    R"wkt(ANGLEUNIT["degree",0.0174532925199433]],PARAMETER["Longitude of natural origin",15,)wkt"
    R"wkt(ANGLEUNIT["degree",0.0174532925199433]],PARAMETER["Scale factor at natural origin",0.9996]],)wkt"
    R"wkt(CS[Cartesian,2],AXIS["(E)",east],AXIS["(N)",north],LENGTHUNIT["metre",1],ID["EPSG",32633]])wkt";

double convergence(const std::string& crs, double latitude_deg, double longitude_deg) {
    const auto meridians = meridiansOf(crs);
    return meridians ? convergenceDeg(*meridians, latitude_deg, longitude_deg) : std::nan("");
}

TEST(Meridians, ConvergeAsProjHasThem) {
    EXPECT_NEAR(convergence("EPSG:32633", 45, 17), 1.4145, 0.002);
    EXPECT_NEAR(convergence("EPSG:32633", 60, 12), -2.5987, 0.002);
    EXPECT_NEAR(convergence("EPSG:32733", -33, 13.5), 0.8171, 0.002);
    EXPECT_NEAR(convergence("EPSG:27700", 57, -5), -2.5167, 0.002);
    EXPECT_NEAR(convergence("EPSG:2154", 48, 7.5), 3.2652, 0.005);
    EXPECT_NEAR(convergence("EPSG:5070", 40, -120), -14.4697, 0.05);
    EXPECT_NEAR(convergence("EPSG:3857", 50, 40), 0, 1e-9);
    EXPECT_NEAR(convergence(kUtm33, 45, 17), 1.4145, 0.002);
    EXPECT_NEAR(convergence(kOregon, 44.06, -123.07), -1.7935, 0.005);
    EXPECT_NEAR(convergence("COMPD_CS[\"both\"," + std::string(kOregon) + ",VERT_CS[\"height\"]]", 44.06, -123.07),
                -1.7935, 0.005);
}

TEST(Meridians, AreNotKnownWhereNothingSaysThem) {
    EXPECT_FALSE(meridiansOf(""));
    EXPECT_FALSE(meridiansOf("EPSG:4326"));
    EXPECT_FALSE(meridiansOf("EPSG:28992"));
    EXPECT_FALSE(meridiansOf(R"(GEOGCS["WGS 84",UNIT["degree",0.0174532925199433]])"));
    EXPECT_FALSE(meridiansOf(R"(PROJCS["x",GEOGCS["y"],PROJECTION["Oblique_Stereographic"]])"));
    EXPECT_FALSE(meridiansOf(R"(PROJCS["x",GEOGCS["y",UNIT["grad",0.01570796]],PROJECTION["Transverse_Mercator"]])"));
    EXPECT_FALSE(meridiansOf(R"(PROJCS["x",GEOGCS["y",PRIMEM["Paris",2.337]],PROJECTION["Transverse_Mercator"]])"));
    EXPECT_FALSE(meridiansOf("PROJCS[[[[((("));
}

struct Frame : testing::Test {
    test::TemporaryFolder folder;

    /// A file of one splat with this system and up.
    std::string file(const std::string& crs, std::array<float, 3> up = {0, 0, 1}) const {
        test::Scene scene = test::sceneOf({{{0.5f, 0.5f, 0.5f}, {0, 0, 1}, 0.1f, {}, 0}});
        std::string text;
        for (const char letter : crs) text += letter == '"' ? std::string("\\\"") : std::string(1, letter);
        scene.metadata = crs.empty() ? "{}" : R"({"world":{"crs":")" + text + "\"}}";
        const pro_view view = scene.view();
        pro_world world{};
        std::copy(up.begin(), up.end(), world.up);
        const pro_content content{&scene.info, &view, nullptr, &world, nullptr, 0, nullptr};
        pro_message message{};
        EXPECT_EQ(pro_write_content(folder.file("a.pro").c_str(), &content, 1, &message), PRO_OK) << message.text;
        return folder.file("a.pro");
    }
};

TEST_F(Frame, GridNorthIsTurnedToTrueNorth) {
    const StudyFrame frame = studyFrame(file(kUtm33), {45, 17});
    const double angle =
        1.4145 * std::numbers::pi / 180; // true north lies to the west of the grid's, east of the middle
    EXPECT_NEAR(frame.north[0], -std::sin(angle), 1e-4);
    EXPECT_NEAR(frame.north[1], std::cos(angle), 1e-4);
    EXPECT_EQ(frame.note, "grid north is 1.41 degrees clockwise of true north in WGS 84 / UTM zone 33N");
}

TEST_F(Frame, WithoutASystemNorthIsWhatSceneFilesTake) {
    EXPECT_EQ(studyFrame(file(""), {45, 17}).north, (std::array<double, 3>{0, 1, 0}));
    EXPECT_EQ(studyFrame(file(""), {45, 17}).note, "north is taken for +Y: the scan names no coordinate system");
    const StudyFrame upright = studyFrame(file("", {0, 1, 0}), {45, 17});
    EXPECT_NEAR(upright.north[2], -1, 1e-12);
    EXPECT_EQ(upright.up, (std::array<double, 3>{0, 1, 0}));
    EXPECT_EQ(studyFrame(file("EPSG:28992"), {52, 5}).note,
              "north is taken for +Y: the meridians of EPSG:28992 are not known here");
    EXPECT_EQ(studyFrame(file("", {0, 0, 0}), {45, 17}).note,
              "north is taken for +Y: the scan names no coordinate system; up is taken for +Z: the scan does not say");
}

TEST_F(Frame, WhatIsGivenCounts) {
    const StudyFrame frame = studyFrame(file(kUtm33), {45, 17}, {{0, 0, 2}}, {{3, 0, 5}});
    EXPECT_EQ(frame.up, (std::array<double, 3>{0, 0, 1}));
    EXPECT_NEAR(frame.north[0], 1, 1e-12);
    EXPECT_NEAR(frame.north[2], 0, 1e-12);
}

TEST_F(Frame, WhatIsNoneIsRefused) {
    const auto refused = [&](const std::string& path, GeoPlace place, std::optional<std::array<double, 3>> up = {},
                             std::optional<std::array<double, 3>> north = {}) -> std::string {
        try {
            studyFrame(path, place, up, north);
        } catch (const TraceError& error) {
            return error.what();
        }
        return "";
    };
    EXPECT_EQ(refused(file(kUtm33), {17, 45}),
              "longitude 45 is 30 degrees from the middle of the scan's coordinate system: places are latitude, then "
              "longitude");
    EXPECT_EQ(refused(file(""), {91, 0}), "the latitude must be from -90 to 90 degrees");
    EXPECT_EQ(refused(file(""), {0, 0}, {{0, 0, 0}}),
              "up must be a direction: three finite numbers that are not all 0");
    EXPECT_EQ(refused(file(""), {0, 0}, {}, {{0, std::nan(""), 0}}),
              "north must be a direction: three finite numbers that are not all 0");
    EXPECT_EQ(refused(file(""), {0, 0}, {}, {{0, 0, 1}}), "north must not be along up");
    EXPECT_NE(refused(folder.file("missing.pro"), {0, 0}).find("missing.pro: "), std::string::npos);
}

} // namespace
} // namespace pointrt
