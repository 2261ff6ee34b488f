// SPDX-License-Identifier: Apache-2.0
// pointrt-rays measure, profile, section and compare end to end, in coordinates of a national grid.
#include <algorithm>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "pointrt/pro.hpp"
#include "tests/runtime/rays/cast_command.h"
#include "tests/support/says.h"

namespace pointrt::test {
namespace {

class MeasureCommand : public CastCommand {
protected:
    Outcome measure(const std::string& words) const { return run(POINTRT_RAYS " measure plane.pro " + words); }
    nlohmann::json measured(const std::string& words) const {
        const Outcome result = measure(words + " --json");
        EXPECT_EQ(result.code, 0) << result.err;
        return nlohmann::json::parse(result.out, nullptr, false);
    }
};

const std::string kSquare = R"(--points "500060,4500060,164 500070,4500060,164 500070,4500070,164 500060,4500070,164")";

TEST_F(MeasureCommand, DistancesArePrinted) {
    const std::string points = R"(--points "500060,4500060,164 500063,4500064,176")";
    const Outcome result = measure("--kind distance " + points);
    ASSERT_EQ(result.code, 0) << result.err;
    EXPECT_EQ(result.out, "distance    13.00000\n"
                          "height      12.00000\n"
                          "horizontal  5.00000\n"
                          "slope       67.3801 degrees\n"
                          "dx          3.00000\n"
                          "dy          4.00000\n"
                          "dz          12.00000\n");
    EXPECT_EQ(measured("--kind height " + points + " --up 0,-1,0")["height"], -4);
    EXPECT_NEAR(measured(R"(--kind angle --points "500060,4500060,1 500061,4500060,1 500061,4500060,2")")["angle"], 90,
                1e-6);
    EXPECT_EQ(measured(R"(--kind polyline --points "500060,4500060,1 500061,4500060,1 500061,4500060,4")")["length"],
              4);
}

TEST_F(MeasureCommand, AreasAndFitsKeepNationalCoordinates) {
    const nlohmann::json area = measured("--kind area " + kSquare);
    EXPECT_NEAR(area["area"], 100, 1e-4);
    EXPECT_NEAR(area["plan_area"], 100, 1e-4);
    EXPECT_NEAR(area["perimeter"], 40, 1e-6);
    const nlohmann::json circle = measured("--kind circle " + kSquare);
    EXPECT_NEAR(circle["radius"], 5 * std::sqrt(2), 1e-6);
    EXPECT_NEAR(circle["center_y"], 4500065, 1e-6);
    folder.write("ball.csv", "x,y,z\n500061,4500060,1\n500059,4500060,1\n500060,4500061,1\n500060,4500060,2\n");
    EXPECT_NEAR(measured("--kind sphere --points ball.csv")["radius"], 1, 1e-6);
}

TEST_F(MeasureCommand, VolumesLieOverABase) {
    const nlohmann::json volume = measured("--kind volume " + kSquare + " --base 163 --cell 0.1");
    EXPECT_NEAR(volume["cut"], 100, 0.05);
    EXPECT_EQ(volume["fill"], 0);
    EXPECT_NEAR(volume["covered"], 1, 1e-9);
    const Outcome hole =
        measure(R"(--kind volume --points "499990,4500060,160 500070,4500060,160 500070,4500070,160" --cell 1)");
    EXPECT_SAYS(hole.err, "measure: *no surface*covered\n");
}

TEST_F(MeasureCommand, SnappedPointsLieOnTheSurface) {
    const nlohmann::json snapped =
        measured(R"(--kind distance --snap --points "500060,4500060,170 500070,4500060,160")");
    EXPECT_NEAR(snapped["distance"], 10, 0.01);
    EXPECT_NEAR(snapped["points"][0][2], 164, 1e-3);
    EXPECT_NEAR(snapped["snapped_by"], 6, 1e-3);
}

TEST_F(MeasureCommand, FilesHoldTheGeometry) {
    ASSERT_EQ(measure("--kind area -o out.geojson " + kSquare).code, 0);
    const auto json = nlohmann::json::parse(text("out.geojson"));
    EXPECT_EQ(json["features"][0]["geometry"]["type"], "Polygon");
    EXPECT_EQ(json["features"][0]["geometry"]["coordinates"][0][4][0], 500060);
    EXPECT_EQ(json["features"][0]["properties"]["area"], 100);
    ASSERT_EQ(measure("--kind area -o out.dxf " + kSquare).code, 0);
    EXPECT_NE(text("out.dxf").find("10\n500070.00000\n20\n4500070.00000\n30\n164.00000\n"), std::string::npos);
    EXPECT_NE(text("out.dxf").find("70\n9\n"), std::string::npos) << "closed";
    ASSERT_EQ(measure("--kind circle -o out.dxf " + kSquare).code, 0);
    EXPECT_NE(text("out.dxf").find("\nPOINT\n"), std::string::npos);
    ASSERT_EQ(measure("--kind area -o out.csv " + kSquare).code, 0);
    EXPECT_TRUE(text("out.csv").starts_with("name,value,unit\narea,100,\n")) << text("out.csv");
}

TEST_F(MeasureCommand, MistakesAreNamed) {
    const std::string command = POINTRT_RAYS " measure plane.pro --kind ";
    expectRefused(2, "--points: *2 points*4*", command + "distance " + kSquare);
    expectRefused(2, "--points: \"1,2\"*x,y,z*", command + "angle --points '1,2 3,4'");
    expectRefused(2, "*--base*--cell*volume*", command + "area --base 3 " + kSquare);
    expectRefused(2, "out.txt: *suffix*.geojson*", command + "area -o out.txt " + kSquare);
    expectRefused(2, "*line*", command + "circle --points '1,2,3 2,3,4 3,4,5'");
    expectRefused(1, "missing.csv: No such file or directory", command + "area --points missing.csv");
    folder.write("points.csv", "1 2 3\n1 2 x\n");
    expectRefused(1, "points.csv:2: \"x\" *number", command + "distance --points points.csv");
    expectRefused(1, "nothing.pro: No such file or directory",
                  POINTRT_RAYS " measure nothing.pro --kind area " + kSquare);
}

TEST_F(MeasureCommand, ProfilesAreWritten) {
    const std::string profile = POINTRT_RAYS " profile plane.pro --line '499990,4500064 500030,4500064' --step 10 -o ";
    ASSERT_EQ(run(profile + "out.csv").code, 0);
    EXPECT_EQ(text("out.csv").substr(0, 144), "station,x,y,z,height\n"
                                              "0.00000,499990.00000,4500064.00000,,\n"
                                              "10.00000,500000.00000,4500064.00000,,\n"
                                              "20.00000,500010.00000,4500064.00000,,\n"
                                              "30.00000,5");
    double station = 0, x = 0, y = 0, z = 0, height = 0;
    const std::string all = text("out.csv"), last = all.substr(all.rfind("\n40.0"));
    ASSERT_EQ(std::sscanf(last.c_str(), "%lf,%lf,%lf,%lf,%lf", &station, &x, &y, &z, &height), 5) << last;
    EXPECT_EQ(x, 500030);
    EXPECT_NEAR(z, 164, 3e-3); // normals are rounded, by 3e-4 of the discs' radius of 5 m
    EXPECT_EQ(height, z);
    ASSERT_EQ(run(profile + "out.dxf").code, 0);
    EXPECT_NE(text("out.dxf").find("POLYLINE"), std::string::npos);
    ASSERT_EQ(run(profile + "out.svg --width 2").code, 0);
    EXPECT_TRUE(text("out.svg").starts_with("<svg ") && text("out.svg").ends_with("</svg>\n"));
    EXPECT_NE(text("out.svg").find("<polyline"), std::string::npos);
    ASSERT_EQ(run(profile + "out.csv --all").code, 0);
    EXPECT_EQ(run(profile + "out.csv --all --width 2").code, 2);
    EXPECT_EQ(run(profile + "out.csv --up 0,1,0").code, 2) << "x,y are no place where y is up";
    EXPECT_EQ(run(profile + "out.png").code, 2);
}

TEST_F(MeasureCommand, SectionsAreWritten) {
    const std::string section = POINTRT_RAYS " section plane.pro --plane x=500064 -o ";
    ASSERT_EQ(run(section + "out.geojson --height 164.5").code, 0) << "the first section is empty";
    const auto json = nlohmann::json::parse(text("out.geojson"));
    ASSERT_EQ(json["features"].size(), 1u);
    const auto& feature = json["features"][0];
    EXPECT_EQ(feature["properties"]["section"], 2);
    ASSERT_EQ(feature["geometry"]["coordinates"].size(), 2u) << "a level plane is one straight line";
    for (const auto& point : feature["geometry"]["coordinates"]) {
        EXPECT_EQ(point[0], 500064);
        EXPECT_NEAR(point[2], 164, 3e-3); // normals are rounded, by 3e-4 of the discs' radius of 5 m
    }
    ASSERT_EQ(run(section + "out.csv --flat").code, 0);
    double y = 0, z = 0;
    ASSERT_EQ(std::sscanf(text("out.csv").c_str(), "section,line,x,y,z\n1,1,%lf,%lf,0.0", &y, &z), 2)
        << text("out.csv");
    EXPECT_NEAR(y, 4500012.8, 5) << "y grows to the right";
    EXPECT_NEAR(z, 164, 3e-3);
    ASSERT_EQ(run(section + "out.dxf").code, 0);
    EXPECT_NE(text("out.dxf").find("8\nsection_1"), std::string::npos);
    ASSERT_EQ(run(section + "out.svg --clip 500000,4500000,100,500128,4500064,228").code, 0);
    EXPECT_TRUE(text("out.svg").starts_with("<svg ") && text("out.svg").ends_with("</svg>\n"));
    const Outcome nothing = run(POINTRT_RAYS " section plane.pro --height 180 -o out.dxf");
    EXPECT_EQ(nothing.code, 0);
    EXPECT_SAYS(nothing.err, "section: height 180 *no surface*\n");
    EXPECT_EQ(text("out.dxf").find("POLYLINE"), std::string::npos);
}

TEST_F(MeasureCommand, MistakesInSectionsAreNamed) {
    const std::string section = POINTRT_RAYS " section plane.pro -o out.dxf";
    expectRefused(2, "--height *--plane*", section);
    expectRefused(2, "--plane: \"w=3\"*section*", section + " --plane w=3");
    expectRefused(2, "--plane: z=3:0.5: *thickness*", section + " --plane z=3:0.5");
    expectRefused(2, "--step: *", section + " --height 1 --step 0");
    expectRefused(2, "*2^22 rays*", section + " --height 1 --step 1e-9");
    expectRefused(2, "out.png: *suffix*", POINTRT_RAYS " section plane.pro --height 1 -o out.png");
}

TEST_F(MeasureCommand, AMovedCopyIsComparedToAMillimetre) {
    GridPlace place;
    place.origin[2] += 0.01;
    writeScan(folder.file("before.pro"), planeSplats(100, 0.5f), {});
    writeScan(folder.file("moved.pro"), planeSplats(100, 0.5f), place);
    const Outcome result = run(POINTRT_RAYS " compare before.pro moved.pro --tolerance 0.005 --json -o out.csv");
    ASSERT_EQ(result.code, 0) << result.err;
    const auto json = nlohmann::json::parse(result.out);
    EXPECT_EQ(json["points"], 10000);
    EXPECT_EQ(json["measured"], 10000);
    EXPECT_NEAR(json["mean"], 0.01, 1e-3);
    EXPECT_NEAR(json["standard_deviation"], 0, 1e-3);
    EXPECT_NEAR(json["absolute_95_percent"], 0.01, 1e-3);
    EXPECT_EQ(json["beyond_tolerance"], 1);
    EXPECT_TRUE(text("out.csv").starts_with("x,y,z,nx,ny,nz,radius,distance\n"));
    // without a file, and the file of points as input again
    EXPECT_EQ(run(POINTRT_RAYS " compare before.pro moved.pro -o out.ply -q").code, 0);
    EXPECT_EQ(run(POINTRT_RAYS " compare before.pro out.ply --json").out,
              run(POINTRT_RAYS " compare before.pro moved.pro --json").out);
    folder.write("bare.csv", "500064,4500064,165\n");
    expectRefused(1, "bare.csv: *normals*", POINTRT_RAYS " compare plane.pro bare.csv");
    expectRefused(2, "two scans*1*", POINTRT_RAYS " compare plane.pro");
}

/// The copy is the scan with an additional attribute: viewing distances needs no new bake.
TEST_F(MeasureCommand, DistancesBecomeAnAttributeOfACopy) {
    writeScan(folder.file("before.pro"), planeSplats(50, 0.5f), {});
    folder.write("moved.toml", "[[instance]]\nfile = \"before.pro\"\ntranslate = [0.0, 0.0, 0.25]\n");
    ASSERT_EQ(run(POINTRT_RAYS " compare before.pro moved.toml -q -o out.pro").code, 0);
    const ProFile before(folder.file("before.pro")), copy(folder.file("out.pro"));
    EXPECT_TRUE(std::ranges::equal(before.splats(), copy.splats()));
    ASSERT_TRUE(copy.attribute("distance"));
    const pro_attribute& distance = *copy.attribute("distance");
    for (std::size_t i = 0; i < copy.info().splat_count; ++i)
        ASSERT_NEAR(pro_attribute_value(&distance, i), 0.25, 1e-3) << i;
    // once more: the old distances are replaced
    ASSERT_EQ(run(POINTRT_RAYS " compare before.pro out.pro -q -o again.pro").code, 0);
    const ProFile again(folder.file("again.pro"));
    EXPECT_EQ(again.attributes().size(), 1u);
    EXPECT_NEAR(again.attribute("distance")->high, 0, 1e-3);
    ASSERT_EQ(run(POINTRT_RAYS " compare before.pro before.pro -q -o out.ply").code, 0);
    expectRefused(2, "-o: *single .pro scan*.ply", POINTRT_RAYS " compare before.pro out.ply -o other.pro");
}

} // namespace
} // namespace pointrt::test
