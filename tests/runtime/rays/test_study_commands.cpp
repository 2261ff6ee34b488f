// SPDX-License-Identifier: Apache-2.0
// pointrt-rays sun and viewshed end to end.
#include <cstring>
#include <sstream>

#include "format/pointio/input_order.h"
#include "pointrt/pro.hpp"
#include "tests/runtime/rays/cast_command.h"
#include "tests/support/says.h"

namespace pointrt::test {
namespace {

/// plane.pro, and tower.pro, a box above it.
class StudyCommand : public CastCommand {
protected:
    StudyCommand() {
        std::vector<pro_splat> box;
        for (pro_splat splat : planeSplats(20, 0.6f, 0.4f)) {
            box.push_back(splat);
            splat.normal[2] = 0; // walls: the plane rotated about its middle
            const float x = splat.position[0], y = splat.position[1];
            for (const float side : {0.4f, 0.6f}) {
                pro_splat wall = splat;
                wall.normal[0] = side < 0.5f ? -1.0f : 1.0f;
                wall.position[0] = side;
                wall.position[1] = y;
                wall.position[2] = 0.5f + 0.5f * (x - 0.4f);
                box.push_back(wall);
            }
        }
        writeScan(folder.file("tower.pro"), box, {});
    }

    Outcome sun(const std::string& words) const { return run(POINTRT_RAYS " sun " + words); }
    Outcome viewshed(const std::string& words) const { return run(POINTRT_RAYS " viewshed " + words); }

    /// The fields of each line of a CSV file.
    std::vector<std::vector<std::string>> table(const std::string& name) const {
        std::istringstream lines(text(name));
        std::vector<std::vector<std::string>> rows;
        for (std::string line; std::getline(lines, line);) {
            std::istringstream words(line);
            rows.emplace_back();
            for (std::string word; std::getline(words, word, ',');) rows.back().push_back(word);
        }
        return rows;
    }
};

const std::string kDay = " --at 47.4,15 --date 2026-06-21 ";

TEST_F(StudyCommand, SunIsWrittenBesideThePointsColumns) {
    const Outcome result = sun("plane.pro" + kDay + "--every 60 -o out.csv --sky --sky-rays 16 --stats stats.json");
    ASSERT_EQ(result.code, 0) << result.err;
    EXPECT_SAYS(result.err, "sun: 16 instants, 16.00 hours *UTC+01:00 *longitude*north *+Y*up *+Z*\n");
    const auto rows = table("out.csv");
    ASSERT_EQ(rows.size(), 401u);
    EXPECT_EQ(text("out.csv").substr(0, 35), "x,y,z,nx,ny,nz,radius,sun_hours,sky");
    for (std::size_t i = 1; i < rows.size(); ++i) {
        EXPECT_EQ(rows[i][7], "16") << i;
        EXPECT_EQ(rows[i][8], "1") << i;
    }
    EXPECT_NE(text("stats.json").find("\"instants\": 16"), std::string::npos);
    EXPECT_NE(text("stats.json").find("\"points\": 400"), std::string::npos);
}

TEST_F(StudyCommand, SeveralScansShadeEachOtherAndAreNumbered) {
    const Outcome result = sun("plane.pro tower.pro" + kDay + "--every 60 -q -o out.csv");
    ASSERT_EQ(result.code, 0) << result.err;
    EXPECT_EQ(result.err, "");
    const auto rows = table("out.csv");
    ASSERT_EQ(rows[0].back(), "sun_hours");
    ASSERT_EQ(rows[0][7], "instance_id");
    std::size_t shaded = 0;
    for (std::size_t i = 1; i < rows.size(); ++i) {
        EXPECT_EQ(rows[i][7], i <= 400 ? "0" : "1");
        shaded += i <= 400 && std::stod(rows[i].back()) < 15.5;
    }
    EXPECT_GT(shaded, 20u);
}

TEST_F(StudyCommand, PointsOfAListGetResults) {
    // in the open, under the roof, and looking away from the sun
    folder.write("list.csv", "x,y,z,nx,ny,nz\n500064,4500110,164.5,0,0,1\n500064,4500064,165,0,0,1\n"
                             "500064,4500110,164.5,0,0,-1\n");
    ASSERT_EQ(sun("plane.pro tower.pro --points list.csv --sides front" + kDay + "--every 60 -q -o out.csv").code, 0);
    EXPECT_EQ(table("out.csv")[1].back(), "16");
    EXPECT_LT(std::stod(table("out.csv")[2].back()), 12);
    EXPECT_EQ(table("out.csv")[3].back(), "0");
    ASSERT_EQ(run("tail -n +2 list.csv | cut -d, -f1-3 | " POINTRT_RAYS " sun plane.pro --points -" + kDay +
                  "--every 60 -q -o out.csv")
                  .code,
              0);
    EXPECT_EQ(text("out.csv").substr(0, 16), "x,y,z,sun_hours\n");
    EXPECT_EQ(table("out.csv").size(), 4u);
}

TEST_F(StudyCommand, PointsOfScanFilesKeepTheirColumns) {
    // the scan's points and discs from a file give the same hours
    ASSERT_EQ(sun("plane.pro tower.pro" + kDay + "--every 60 -q -o own.ply").code, 0);
    ASSERT_EQ(sun("plane.pro tower.pro --points own.ply" + kDay + "--every 60 -q -o again.ply").code, 0);
    EXPECT_EQ(text("again.ply"), text("own.ply"));
    ASSERT_EQ(sun("plane.pro" + kDay + "--every 60 -q -o own.csv").code, 0);
    ASSERT_EQ(sun("plane.pro" + kDay + "--every 60 -q -o own.las").code, 0);
    ASSERT_EQ(viewshed("plane.pro --points own.las --from 500064,4500064,180 -q -o seen.csv").code, 0);
    const auto rows = table("seen.csv");
    ASSERT_EQ(rows.size(), 401u);
    const auto column = [&](const std::string& name) {
        return static_cast<std::size_t>(std::find(rows[0].begin(), rows[0].end(), name) - rows[0].begin());
    };
    ASSERT_LT(column("classification"), rows[0].size());
    for (std::size_t i = 1; i < rows.size(); ++i) {
        EXPECT_EQ(rows[i][column("sun_hours")], "16");
        EXPECT_EQ(rows[i][column("observer_0")], "1");
        EXPECT_NEAR(std::stod(rows[i][0]), std::stod(table("own.csv")[i][0]), 1e-4);
    }
    ASSERT_EQ(sun("plane.pro --points own.las" + kDay + "--every 60 -q -o again.las").code, 0);
    EXPECT_EQ(text("again.las").size(), text("own.las").size()); // the old hours are replaced
}

TEST_F(StudyCommand, AttributesAreKeptAndOldResultsReplaced) {
    const std::string tiny = POINTRT_GOLDEN_DIR "/tiny_compact_scan.pro";
    ASSERT_EQ(sun(tiny + kDay + "--every 60 -q -o out.ply").code, 0);
    EXPECT_NE(text("out.ply").find("element vertex 5\n"), std::string::npos);
    EXPECT_NE(text("out.ply").find("property uchar classification\n"), std::string::npos);
    ASSERT_EQ(sun(tiny + kDay + "--every 60 -q -o out.las").code, 0);
    const std::string las = text("out.las");
    EXPECT_EQ(las.substr(0, 4), "LASF");
    EXPECT_NE(las.find("sun_hours"), std::string::npos);
    const Outcome stream = sun(tiny + kDay + "--every 60 -q -o -");
    EXPECT_EQ(stream.code, 0);
    EXPECT_EQ(stream.out, text("out.ply"));
}

/// Rows of a .pro are its splats in their order, which is not that of the input.
TEST_F(StudyCommand, ResultsBecomeAttributesInTheOrderOfTheFile) {
    ASSERT_EQ(sun("tower.pro" + kDay + "--every 60 -q -o out.pro").code, 0);
    ASSERT_EQ(sun("tower.pro" + kDay + "--every 60 -q -o out.csv").code, 0);
    const ProFile copy(folder.file("out.pro"));
    const pro_attribute* const hours = copy.attribute("sun_hours");
    ASSERT_TRUE(hours);
    const auto rows = table("out.csv"); // in the order of the input
    ASSERT_EQ(rows.size(), copy.info().splat_count + 1u);
    const std::vector<std::uint32_t> order = inputOrder(copy);
    for (std::size_t i = 0; i < order.size(); ++i)
        ASSERT_NEAR(pro_attribute_value(hours, order[i]), std::stod(rows[i + 1][7]), 1e-4) << i;
    EXPECT_LT(hours->low, hours->high) << "they must differ to distinguish orders";
    expectRefused(2, "-o: *single .pro scan*",
                  POINTRT_RAYS " sun plane.pro tower.pro" + kDay + "--every 60 -o other.pro");
}

TEST_F(StudyCommand, ViewshedListsWhatObserversSee) {
    // one high above open ground, one inside the tower, both raised by 1 m
    const Outcome result = viewshed("plane.pro tower.pro --from 500020,4500064,179 --from 500064,4500064,168 "
                                    "--height 1 -o out.csv --stats stats.json");
    ASSERT_EQ(result.code, 0) << result.err;
    EXPECT_TRUE(result.err.starts_with("viewshed: observer 0 sees ")) << result.err;
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 2);
    const auto rows = table("out.csv");
    const std::size_t last = rows[0].size() - 1;
    ASSERT_EQ(rows[0][last - 2] + rows[0][last - 1] + rows[0][last], "seen_byobserver_0observer_1");
    std::size_t seen = 0;
    for (std::size_t i = 1; i < rows.size(); ++i) {
        EXPECT_EQ(std::stoi(rows[i][last - 2]), std::stoi(rows[i][last - 1]) + std::stoi(rows[i][last]));
        const double x = std::stod(rows[i][0]), y = std::stod(rows[i][1]);
        const bool west = x<500050, behind = x> 500078 && x < 500090 && std::abs(y - 4500064) < 5;
        if (i <= 400 && west) {
            EXPECT_EQ(rows[i][last - 1], "1") << x << " " << y;
        }
        if (i <= 400 && behind) {
            EXPECT_EQ(rows[i][last - 1], "0") << x << " " << y;
        }
        seen += rows[i][last - 1] == "1";
    }
    EXPECT_GT(seen, 300u);
    ASSERT_EQ(viewshed("plane.pro --from 500020,4500064,180 --radius 17 -q -o out.csv").code, 0);
    for (const auto& row : table("out.csv"))
        if (row[0] != "x") {
            const double distance = std::hypot(std::stod(row[0]) - 500020, std::stod(row[1]) - 4500064, 16);
            EXPECT_EQ(row.back(), distance <= 17 ? "1" : "0");
        }
}

TEST_F(StudyCommand, UsageErrorsAreOneLine) {
    const auto refused = [&](const std::string& reason, const std::string& words) {
        expectRefused(2, reason + "*(see --help)", POINTRT_RAYS " " + words);
    };
    const std::string start = "sun plane.pro -o out.csv ";
    refused("--at *required", "sun plane.pro --date 2026-06-21 -o out.csv");
    refused("--date *required", "sun plane.pro --at 47,8 -o out.csv");
    refused("--at: \"47\" *LAT,LON", start + "--date 2026-06-21 --at 47");
    refused("--at: *latitude*-90 *90", start + "--date 2026-06-21 --at 147,8");
    refused("--at: *longitude*-180 *180", start + "--date 2026-06-21 --at 47,nan");
    refused("--date: 2026-02-30 *exist", start + "--at 47,8 --date 2026-02-30");
    refused("--date: \"21.6.2026\" *date", start + "--at 47,8 --date 21.6.2026");
    refused("--date: 1492-10-12 *1900 *2100", start + "--at 47,8 --date 1492-10-12");
    refused("*last *before", start + "--at 47,8 --date 2026-06-21 --to 2026-06-20");
    refused("--every: \"0\" *0 *1440", start + kDay + "--every 0");
    refused("--every: \"-5\" *0 *1440", start + kDay + "--every=-5");
    refused("*million", start + kDay + "--every 0.0001");
    refused("--zone: \"CET\" *UTC", start + kDay + "--zone CET");
    refused("--sky-rays needs --sky", start + kDay + "--sky-rays 5");
    refused("--sides: \"left\" *auto", start + kDay + "--sides left");
    refused("north *up", start + kDay + "--north 0,0,1");
    refused("out.txt: *.ply, *.las, .laz", "sun plane.pro -o out.txt" + kDay);
    refused("plane.pro: *input", "sun plane.pro -o plane.pro" + kDay);
    refused("--from *required", "viewshed plane.pro -o out.csv");
    refused("--from: \"1,2\" *X,Y,Z", "viewshed plane.pro --from 1,2 -o out.csv");
    refused("--from: \"1,2,nan\" *X,Y,Z", "viewshed plane.pro --from 1,2,nan -o out.csv");
    refused("--radius: \"0\" *0 *1e+30", "viewshed plane.pro --from 1,2,3 --radius 0 -o out.csv");
}

TEST_F(StudyCommand, InvalidPointsAreNamedByTheirPlace) {
    const auto refused = [&](const std::string& reason, const std::string& name, const std::string& bytes) {
        folder.write(name, bytes);
        expectRefused(1, reason, POINTRT_RAYS " sun plane.pro -q -o out.csv --points " + name + kDay);
    };
    refused("list.csv:1: *columns*x,y,z,nx,ny,nz", "list.csv", "id,height\n1,2\n");
    refused("list.csv:1: 2 *3*6", "list.csv", "1,2\n");
    refused("list.csv:2: 6 *first*3", "list.csv", "1 2 3\n1 2 3 0 0 1\n");
    refused("list.csv:2: *finite", "list.csv", "1 2 3\n1 2 nan\n");
    refused(
        "list.npy: *shape*(2, 2)*(N, 3)*(N, 6)", "list.npy",
        arrayBytes("{'descr': '<f8', 'fortran_order': False, 'shape': (2, 2), }", std::string(32, '\0').data(), 32));
    refused("list.ply: *header", "list.ply", "ply\nformat ascii 1.0\n");
    refused("list.ply: point 1: *position*finite", "list.ply",
            "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float y\nproperty float z\n"
            "end_header\n1 2 3\n1 nan 3\n");
    refused("list.las: *header", "list.las", "LASF and no more");
    expectRefused(1, "missing.csv: No such file or directory",
                  POINTRT_RAYS " sun plane.pro -q -o out.csv --points missing.csv" + kDay);
    expectRefused(1, "missing.pro: No such file or directory", POINTRT_RAYS " sun missing.pro -q -o out.csv" + kDay);
    expectRefused(4, "nowhere/out.csv: *folder", POINTRT_RAYS " sun plane.pro -q -o nowhere/out.csv" + kDay);
}

TEST_F(StudyCommand, NoPointsGiveAnEmptyTable) {
    folder.write("none.csv", "x,y,z\n");
    ASSERT_EQ(sun("plane.pro --points none.csv" + kDay + "-q -o out.csv").code, 0);
    EXPECT_EQ(text("out.csv"), "x,y,z,sun_hours\n");
}

} // namespace
} // namespace pointrt::test
