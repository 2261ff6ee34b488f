// SPDX-License-Identifier: Apache-2.0
// pointrt-rays sun and viewshed on tile sets and scene files, compared with the same points in one file.
#include <map>
#include <sstream>

#include "tests/runtime/rays/cast_command.h"
#include "tests/runtime/rays/set_scenes.h"

namespace pointrt::test {
namespace {

const std::string kStudyScenesDay = " --at 47.4,15 --date 2026-06-21 --every 120 -q ";

class StudyOfSets : public CastCommand {
protected:
    static void SetUpTestSuite() { ball = new SphereInTiles; }
    static void TearDownTestSuite() {
        delete ball;
        ball = nullptr;
    }
    StudyOfSets() {
        std::filesystem::create_directory_symlink(ball->tiles(), folder.file("ball.proset"));
        std::filesystem::create_symlink(ball->whole(), folder.file("ball.pro"));
    }

    using Rows = std::vector<std::map<std::string, double>>;
    Rows table(const std::string& words) const {
        const Outcome result = run(POINTRT_RAYS " " + words + " -o out.csv");
        EXPECT_EQ(result.code, 0) << result.err;
        std::istringstream lines(text("out.csv"));
        const auto wordsOf = [](const std::string& line) {
            std::istringstream in(line);
            std::vector<std::string> all;
            for (std::string word; std::getline(in, word, ',');) all.push_back(word);
            return all;
        };
        std::string line;
        std::getline(lines, line);
        const std::vector<std::string> names = wordsOf(line);
        Rows rows;
        while (std::getline(lines, line)) {
            const std::vector<std::string> values = wordsOf(line);
            for (std::size_t k = rows.size(), i = 0; i < names.size(); ++i) {
                if (i == 0) rows.emplace_back();
                rows[k][names[i]] = std::stod(values.at(i));
            }
        }
        return rows;
    }

    static inline SphereInTiles* ball = nullptr;
};

/// The number of rows that differ in a column. Matches rows by "number", because the order of points differs.
std::size_t differences(const std::vector<std::map<std::string, double>>& tiles,
                        const std::vector<std::map<std::string, double>>& whole, const std::string& column,
                        const std::vector<Vec3>& points) {
    std::size_t count = 0;
    std::map<std::uint32_t, double> of_whole;
    for (std::size_t i = 0; i < whole.size(); ++i) of_whole[static_cast<std::uint32_t>(i)] = whole[i].at(column);
    for (const auto& row : tiles) {
        const auto number = static_cast<std::uint32_t>(row.at("number"));
        EXPECT_NEAR(row.at("x"), points[number].x, 1e-3);
        EXPECT_NEAR(row.at("x"), whole[number].at("x"), 1e-3);
        count += row.at(column) != of_whole.at(number);
    }
    return count;
}

TEST_F(StudyOfSets, PointsHaveTheHoursThatTheyHaveInOneFile) {
    const Rows whole = table("sun ball.pro" + kStudyScenesDay), tiles = table("sun ball.proset" + kStudyScenesDay);
    ASSERT_EQ(whole.size(), SphereInTiles::kSplats);
    ASSERT_EQ(tiles.size(), SphereInTiles::kSplats);
    // radii and positions are rounded differently, which affects a few rays that graze the ball
    EXPECT_LE(differences(tiles, whole, "sun_hours", ball->points), SphereInTiles::kSplats / 200);
    const Rows streamed =
        table("sun ball.proset --memory " + std::to_string(2 * ball->largestTile()) + kStudyScenesDay);
    EXPECT_TRUE(streamed == tiles);
}

TEST_F(StudyOfSets, ObserversSeeWhatTheySeeInOneFile) {
    const std::string eyes = " --from 500120,4500000,160 --from 500000,4500000,300 -q";
    const Rows whole = table("viewshed ball.pro" + eyes), tiles = table("viewshed ball.proset" + eyes);
    for (const char* column : {"seen_by", "observer_0", "observer_1"})
        EXPECT_LE(differences(tiles, whole, column, ball->points), SphereInTiles::kSplats / 500) << column;
    ASSERT_EQ(run(POINTRT_RAYS " viewshed ball.proset -q -o out.laz" + eyes).code, 0);
    ASSERT_EQ(run(POINTRT_RAYS " viewshed ball.proset -q -o -" + eyes).code, 0);
    EXPECT_NE(text(".out").find("element vertex " + std::to_string(SphereInTiles::kSplats) + "\n"), std::string::npos);
}

TEST_F(StudyOfSets, InstancesOfSceneFilesShadeEachOther) {
    // a roof 30 m above the plane: the same plane at half its size
    folder.write("scene.toml", "[[instance]]\nfile = \"plane.pro\"\n[[instance]]\nfile = \"plane.pro\"\nscale = 0.5\n"
                               "translate = [250032, 2250032, 112]\n[[instance]]\nfile = \"ball.proset\"\n"
                               "translate = [1000, 0, 0]\n");
    const Rows rows = table("sun scene.toml" + kStudyScenesDay + "--sky --sky-rays 64");
    ASSERT_EQ(rows.size(), 800 + SphereInTiles::kSplats);
    for (std::size_t i = 0; i < 800; ++i) {
        EXPECT_EQ(rows[i].at("instance_id"), i < 400 ? 0 : 1);
        const double middle = std::hypot(rows[i].at("x") - 500064, rows[i].at("y") - 4500064);
        if (i >= 400) {
            EXPECT_NEAR(rows[i].at("z"), 194, 1e-3);
            EXPECT_EQ(rows[i].at("sun_hours"), 16);
        } else if (middle < 5) {
            EXPECT_LT(rows[i].at("sun_hours"), 11);
            EXPECT_LT(rows[i].at("sky_view"), 0.6);
        }
    }
    EXPECT_EQ(rows.back().at("instance_id"), 2);
    const Rows asked = table("sun scene.toml --points ball.proset" + kStudyScenesDay);
    EXPECT_EQ(asked.size(), SphereInTiles::kSplats);
    folder.write("shapes.toml", "[[shape]]\ntype = \"sphere\"\ncenter = [0, 0, 0]\nradius = 1\nmaterial = \"m\"\n"
                                "[material.m]\ncolor = [1, 1, 1]\n");
    expectRefused(1, "shapes.toml: *no scan", POINTRT_RAYS " sun shapes.toml -o out.csv" + kStudyScenesDay);
}

} // namespace
} // namespace pointrt::test
