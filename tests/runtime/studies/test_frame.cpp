// SPDX-License-Identifier: Apache-2.0
// Up and true north: as given, by the coordinate system of a file, or assumed.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "format/crs/projected_crs.h"
#include "pointrt/studies.hpp"
#include "scene_builder.h"
#include "tests/support/says.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/wkt.h"

namespace pointrt {
namespace {

struct Frame : testing::Test {
    test::TemporaryFolder folder;

    /// A file of one splat with this coordinate system and up.
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

/// Frames that PROJ decides.
struct GridFrame : Frame {
    void SetUp() override {
        if (!isProjInstalled())
            GTEST_SKIP() << "SKIPPED: PROJ is not installed (Debian, Ubuntu: libproj25): true north is not checked";
    }
};

TEST_F(GridFrame, GridNorthIsTurnedToTrueNorth) {
    const StudyFrame frame = studyFrame(file(test::kUtm33), {45, 17});
    // east of the central meridian true north lies west of grid north (tests/format/crs)
    const double convergence = 1.4145 * std::numbers::pi / 180;
    EXPECT_NEAR(frame.north[0], -std::sin(convergence), 1e-4);
    EXPECT_NEAR(frame.north[1], std::cos(convergence), 1e-4);
    EXPECT_SAYS(frame.note, "grid north *1.41 *clockwise *WGS 84 / UTM zone 33N");
    EXPECT_SAYS(studyFrame(file("EPSG:2056"), {47.3769, 8.5417}).note, "grid north *0.81 *clockwise *CH1903+ / LV95");
}

TEST_F(GridFrame, PlacesFarFromTheGridAreRefused) {
    const auto isRefused = [&](const char* crs, GeoPlace place) {
        try {
            studyFrame(file(crs), place);
        } catch (const TraceError& error) {
            EXPECT_EQ(error.kind, TraceError::Kind::kBadUsage);
            return true;
        }
        return false;
    };
    EXPECT_TRUE(isRefused(test::kUtm33, {17, 45}));   // longitude first
    EXPECT_TRUE(isRefused("EPSG:2056", {8.5, 47.4})); // longitude first
    EXPECT_FALSE(isRefused("EPSG:32633", {45, 9}));   // half a zone to the west
    EXPECT_FALSE(isRefused("EPSG:32601", {65, 179})); // the same across the antimeridian
    EXPECT_FALSE(isRefused("EPSG:3857", {-80, 180}));
    EXPECT_TRUE(isRefused("EPSG:3413", {-60, 10})); // Arctic
}

TEST_F(GridFrame, SystemsWithoutAGridNorthAreNamed) {
    EXPECT_SAYS(studyFrame(file("EPSG:4326"), {52, 5}).note, "north *+Y: EPSG:4326 *projected");
}

TEST_F(Frame, WithoutASystemNorthIsThatOfSceneFiles) {
    EXPECT_EQ(studyFrame(file(""), {45, 17}).north, (std::array<double, 3>{0, 1, 0}));
    EXPECT_SAYS(studyFrame(file(""), {45, 17}).note, "north *+Y: *coordinate system");
    const StudyFrame upright = studyFrame(file("", {0, 1, 0}), {45, 17});
    EXPECT_NEAR(upright.north[2], -1, 1e-12);
    EXPECT_EQ(upright.up, (std::array<double, 3>{0, 1, 0}));
    EXPECT_SAYS(studyFrame(file(test::kUtm33, {0, 1, 0}), {45, 17}).note, "north *-Z: up *z axis");
    EXPECT_SAYS(studyFrame(file("", {0, 0, 0}), {45, 17}).note, "north *+Y: *coordinate system; up *+Z: ");
}

TEST_F(Frame, WithoutProjNorthMustBeGiven) {
    if (isProjInstalled()) return; // GridFrame tests this case
    try {
        studyFrame(file("EPSG:2056"), {47, 8});
        FAIL();
    } catch (const TraceError& error) {
        EXPECT_EQ(error.kind, TraceError::Kind::kCannotRun);
        EXPECT_SAYS(error.what(), "*PROJ (libproj.so.25): *libproj25*north");
    }
    EXPECT_SAYS(studyFrame(file("EPSG:2056"), {47, 8}, {}, {{0, 1, 0}}).note, "north *given");
}

TEST_F(Frame, GivenDirectionsOverrideTheFile) {
    const StudyFrame frame = studyFrame(file(test::kUtm33), {45, 17}, {{0, 0, 2}}, {{3, 0, 5}});
    EXPECT_EQ(frame.up, (std::array<double, 3>{0, 0, 1}));
    EXPECT_NEAR(frame.north[0], 1, 1e-12);
    EXPECT_NEAR(frame.north[2], 0, 1e-12);
}

TEST_F(Frame, InvalidPlacesAndDirectionsAreRefused) {
    const auto refused = [&](const std::string& path, GeoPlace place, std::optional<std::array<double, 3>> up = {},
                             std::optional<std::array<double, 3>> north = {}) -> std::string {
        try {
            studyFrame(path, place, up, north);
        } catch (const TraceError& error) {
            return error.what();
        }
        return "";
    };
    EXPECT_SAYS(refused(file(""), {91, 0}), "*latitude *-90 *90");
    EXPECT_SAYS(refused(file(""), {0, 0}, {{0, 0, 0}}), "up *direction");
    EXPECT_SAYS(refused(file(""), {0, 0}, {}, {{0, std::nan(""), 0}}), "north *direction");
    EXPECT_SAYS(refused(file(""), {0, 0}, {}, {{0, 0, 1}}), "north *along up");
    EXPECT_NE(refused(folder.file("missing.pro"), {0, 0}).find("missing.pro: "), std::string::npos);
}

} // namespace
} // namespace pointrt
