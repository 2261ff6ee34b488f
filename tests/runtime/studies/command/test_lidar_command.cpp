// SPDX-License-Identifier: Apache-2.0
// pointrt-rays lidar end to end: the sensors of docs/, every output format, and errors.
#include <cmath>
#include <sstream>

#include "tests/runtime/rays/cast_command.h"

namespace pointrt::test {
namespace {

const std::string kSensors = POINTRT_DOCS "/sensors/";
const std::string kMiddle = " --pose 500064,4500064,166 "; // 2 m above the plane

/// pointrt-rays lidar in the folder of plane.pro.
class LidarCommand : public CastCommand {
protected:
    Outcome lidar(const std::string& words) const { return run(POINTRT_RAYS " lidar plane.pro " + words); }

    /// Columns of a text file by name.
    struct Rows {
        std::vector<std::string> names;
        std::vector<std::vector<double>> rows;

        std::vector<double> column(const std::string& name) const {
            const auto at = static_cast<std::size_t>(std::find(names.begin(), names.end(), name) - names.begin());
            std::vector<double> numbers;
            for (const std::vector<double>& row : rows) numbers.push_back(row.at(at));
            return numbers;
        }
    };
    Rows rows(const std::string& name) const {
        std::istringstream lines(text(name));
        Rows read;
        std::string line, word;
        std::getline(lines, line);
        std::istringstream first(line);
        while (std::getline(first, word, ',')) read.names.push_back(word);
        while (std::getline(lines, line)) {
            std::istringstream words(line);
            read.rows.emplace_back();
            while (std::getline(words, word, ',')) read.rows.back().push_back(std::stod(word));
        }
        return read;
    }
};

TEST_F(LidarCommand, TheSensorsOfTheDocsRun) {
    const Outcome street = lidar("--sensor " + kSensors + "street.toml" + kMiddle + "-o street.csv -v");
    ASSERT_EQ(street.code, 0) << street.err;
    EXPECT_NE(street.err.find("57600 pulses, "), std::string::npos) << street.err;
    const Rows points = rows("street.csv");
    EXPECT_EQ(points.names, (std::vector<std::string>{"x", "y", "z", "intensity", "return_number", "number_of_returns",
                                                      "gps_time", "ring", "range", "power", "incidence_deg", "pulse",
                                                      "splat_id", "instance_id"}));
    // 22 of 32 beams hit the plane within its 51 m; 1% of their 39600 pulses are dropped
    EXPECT_NEAR(static_cast<double>(points.rows.size()), 0.99 * 22 * 1800, 2500);
    for (const double z : points.column("z")) ASSERT_NEAR(z, 164, 0.1);
    for (const double range : points.column("range")) ASSERT_GT(range, 3.5);

    const std::string over = " --trajectory flight.csv ";
    folder.write("flight.csv", "t,x,y,z,yaw,pitch,roll\n0,500030,4500064,250,0,0,0\n1,500090,4500064,250,0,0,2\n");
    ASSERT_EQ(lidar("--sensor " + kSensors + "flight.toml" + over + "--duration 0.2 -o flight.csv.csv").code, 0);
    EXPECT_EQ(rows("flight.csv.csv").names.back(), "scan_angle_deg");
    EXPECT_EQ(rows("flight.csv.csv").rows.size(), 12000u);
    ASSERT_EQ(lidar("--sensor " + kSensors + "flash.toml" + kMiddle + "-o flash.csv").code, 0);
    EXPECT_EQ(rows("flash.csv").column("ring").back(), 47);
    ASSERT_EQ(lidar("--sensor " + kSensors + "table.toml" + kMiddle + "-o table.csv").code, 0);
    EXPECT_EQ(rows("table.csv").rows.size(), 48u); // all beams point down
}

TEST_F(LidarCommand, EveryFormatHoldsThePoints) {
    const std::string words = "--sensor " + kSensors + "flash.toml" + kMiddle + "--seed 3 -q -o ";
    ASSERT_EQ(lidar(words + "scan.csv").code, 0);
    const std::size_t count = rows("scan.csv").rows.size();
    ASSERT_GT(count, 1000u); // the downward ones of 3072 pulses
    ASSERT_EQ(lidar(words + "scan.ply --stats stats.json").code, 0);
    const std::string ply = text("scan.ply");
    EXPECT_NE(ply.find("element vertex " + std::to_string(count) + "\n"), std::string::npos);
    EXPECT_NE(ply.find("property ushort intensity\n"), std::string::npos);
    EXPECT_NE(text("stats.json").find("\"points\": " + std::to_string(count)), std::string::npos);
    EXPECT_NE(text("stats.json").find("\"pulses\": 3072"), std::string::npos);
    ASSERT_EQ(lidar(words + "scan.las").code, 0);
    const std::string las = text("scan.las");
    EXPECT_EQ(las.substr(0, 4), "LASF");
    EXPECT_EQ(wordAt<std::uint32_t>(las, 107), count); // LAS 1.2: number of points
    EXPECT_EQ(wordAt<std::uint32_t>(las, 111), count); // number of first returns
    ASSERT_EQ(lidar(words + "again.ply").code, 0);
    EXPECT_EQ(text("again.ply"), ply);
}

TEST_F(LidarCommand, ErrorsAreOneLine) {
    folder.write("good.toml", "[flash]\npixels = [4, 3]\nfield_of_view_deg = [40, 30]\nframe_hz = 5\n"
                              "[range]\nmax_m = 10\n");
    folder.write("bad.toml", "[flash]\npixels = [4, 3]\nfield_of_view_deg = [40, 30]\nframe_hz = -5\n"
                             "[range]\nmax_m = 10\n");
    folder.write("bad.csv", "t,x,y,z,qx,qy,qz,qw\n0,1,2,3,0,0,0,0\n");
    const auto refused = [&](int code, const std::string& reason, const std::string& words) {
        expectRefused(code, reason + (code == 2 ? "*(see --help)" : ""), POINTRT_RAYS " lidar " + words);
    };
    const std::string good = "plane.pro --sensor good.toml ", out = " -o out.ply";
    refused(1, "bad.toml:4: key \"flash.frame_hz\": *-5*1e-06 *1000000000",
            "plane.pro --sensor bad.toml" + kMiddle + out);
    refused(1, "missing.toml: No such file or directory", "plane.pro --sensor missing.toml" + kMiddle + out);
    refused(1, "bad.csv:2: *quaternion*0", good + "--trajectory bad.csv" + out);
    refused(1, "missing.pro: No such file or directory", "missing.pro --sensor good.toml" + kMiddle + out);
    refused(2, "good.toml: *--pose *--trajectory", good + out);
    refused(2, "--pose: *X,Y,Z,YAW,PITCH,ROLL", good + "--pose 1,2" + out);
    refused(2, "--pose: *X,Y,Z,YAW,PITCH,ROLL", good + "--pose 1,2,nan" + out);
    refused(2, "duration_s *0", good + kMiddle + "--duration 0" + out);
    refused(2, "out.txt: *.ply, *.las, .laz", good + kMiddle + "-o out.txt");
    refused(2, "-o -: *streamed", good + kMiddle + "-o -");
    refused(2, "good.toml: *input", good + kMiddle + "-o good.toml");
    refused(2, "--attributes: *gloss*none", good + kMiddle + "--attributes gloss" + out);
    refused(2, "--attributes: ring *column", good + kMiddle + "--attributes ring" + out);
    refused(2, "--sensor *required", "plane.pro" + kMiddle + out);
    refused(4, "nowhere/out.ply: *folder", good + kMiddle + "-o nowhere/out.ply");
}

} // namespace
} // namespace pointrt::test
