// SPDX-License-Identifier: Apache-2.0
// Sensor files, beam tables and trajectories: their content, and errors.
#include <gtest/gtest.h>

#include "pointrt/lidar.hpp"
#include "tests/support/says.h"
#include "tests/support/temporary_folder.h"

namespace pointrt::test {
namespace {

const std::string kRange = "[range]\nmax_m = 10\n";
const std::string kFlash = "[flash]\npixels = [4, 3]\nfield_of_view_deg = [40, 30]\nframe_hz = 5\n";

class LidarFiles : public testing::Test {
protected:
    LidarSensorFile read(const std::string& text) { return readLidarSensor(folder.write("sensor.toml", text)); }

    /// The error of a sensor file with this text, without the folder.
    std::string refusal(const std::string& text) {
        return refusalOf([&] { read(text); });
    }
    std::string trajectoryRefusal(const std::string& text) {
        return refusalOf([&] { readLidarTrajectory(folder.write("drive.csv", text)); });
    }

    TemporaryFolder folder;

private:
    template <typename Act>
    std::string refusalOf(const Act& act) {
        try {
            act();
        } catch (const TraceError& error) {
            EXPECT_EQ(error.kind, TraceError::Kind::kBadInput);
            const std::string text = error.what();
            EXPECT_EQ(text.find('\n'), text.npos);
            EXPECT_TRUE(text.starts_with(folder.path.string() + "/")) << text;
            return text.substr(folder.path.string().size() + 1);
        }
        return "nothing was thrown";
    }
};

TEST_F(LidarFiles, ASpinningSensorIsReadCompletely) {
    const LidarSensorFile file = read("[spinning]\nbeams = 3\nlowest_deg = -20\nhighest_deg = 10\nrotation_hz = 20\n"
                                      "step_deg = 0.5\nstart_deg = 90\nclockwise = true\n"
                                      "[range]\nmin_m = 0.5\nmax_m = 100\nnoise_m = 0.02\nnoise_per_m = 0.001\n"
                                      "resolution_m = 0.4\n"
                                      "[beam]\ndivergence_mrad = 2.5\nrays = 19\n"
                                      "[returns]\nkept = \"strongest\"\nmost = 3\n"
                                      "[intensity]\nattribute = \"gloss\"\nattribute_white = 255\nreference_m = 20\n"
                                      "white = 1000\nrange_corrected = true\n"
                                      "[detection]\nthreshold = 0.01\ndrop_probability = 0.1\n"
                                      "[pose]\nposition = [1, 2, 3]\nyaw_deg = 90\n");
    const LidarSensor& s = file.sensor;
    const auto& spinning = std::get<LidarSpinning>(s.pattern);
    EXPECT_EQ(spinning.elevations_deg, (std::vector<double>{-20, -5, 10}));
    EXPECT_EQ(spinning.rotation_hz, 20);
    EXPECT_EQ(spinning.step_deg, 0.5);
    EXPECT_EQ(spinning.start_deg, 90);
    EXPECT_TRUE(spinning.clockwise);
    EXPECT_EQ(s.min_range_m, 0.5);
    EXPECT_EQ(s.max_range_m, 100);
    EXPECT_EQ(s.range_noise_m, 0.02);
    EXPECT_EQ(s.range_noise_per_m, 0.001);
    EXPECT_EQ(s.range_resolution_m, 0.4);
    EXPECT_EQ(s.divergence_mrad, 2.5);
    EXPECT_EQ(s.rays, 19u);
    EXPECT_EQ(s.kept, LidarKept::kStrongest);
    EXPECT_EQ(s.most_returns, 3u);
    EXPECT_EQ(s.reflectance.source, LidarReflectance::Source::kAttribute);
    EXPECT_EQ(s.reflectance.attribute, "gloss");
    EXPECT_EQ(s.reflectance.white, 255);
    EXPECT_EQ(s.reference_range_m, 20);
    EXPECT_EQ(s.white_intensity, 1000);
    EXPECT_TRUE(s.range_corrected);
    EXPECT_EQ(s.detection_threshold, 0.01);
    EXPECT_EQ(s.drop_probability, 0.1);
    ASSERT_EQ(file.trajectory.size(), 1u);
    EXPECT_EQ(file.trajectory[0].position, (std::array{1.0, 2.0, 3.0}));
    EXPECT_EQ(file.trajectory[0].rotation, lidarRotation(90, 0, 0));
}

TEST_F(LidarFiles, OtherPatternsAndPosesAreRead) {
    folder.write("beams.csv", "elevation_deg;azimuth_deg;delay_s\n# two\n-10;20;0\n\n+5;-7;0.01\r\n");
    folder.write("drive.csv", "T X Y Z QX QY QZ QW speed\n1 2 3 4 0 0 0 1 9\n1.5 6 7 8 0 0 2 0 9\n");
    const LidarSensorFile table =
        read("trajectory = \"drive.csv\"\n[table]\nfile = \"beams.csv\"\nrepeat_hz = 10\n" + kRange);
    const auto& beams = std::get<LidarTable>(table.sensor.pattern).beams;
    ASSERT_EQ(beams.size(), 2u);
    EXPECT_EQ(beams[1].azimuth_deg, -7);
    EXPECT_EQ(beams[1].elevation_deg, 5);
    EXPECT_EQ(beams[1].delay_s, 0.01);
    ASSERT_EQ(table.trajectory.size(), 2u);
    EXPECT_EQ(table.trajectory[1].time, 1.5);
    EXPECT_EQ(table.trajectory[1].position, (std::array{6.0, 7.0, 8.0}));
    EXPECT_EQ(table.trajectory[1].rotation, (std::array{0.0, 0.0, 2.0, 0.0}));

    const LidarSensorFile flash = read(kFlash + kRange + "[intensity]\nreflectance = 0.5\n");
    EXPECT_EQ(std::get<LidarFlash>(flash.sensor.pattern).height, 3u);
    EXPECT_EQ(std::get<LidarFlash>(flash.sensor.pattern).width_deg, 40);
    EXPECT_EQ(flash.sensor.reflectance.value, 0.5);
    EXPECT_TRUE(flash.trajectory.empty());

    const LidarSensorFile mirror = read("[oscillating]\nfield_of_view_deg = 30\nscan_hz = 50\npulse_hz = 1e5\n"
                                        "sinusoidal = true\n[intensity]\nreflectance = \"color\"\n" +
                                        kRange + "[pose]\nposition = [0, 0, 9]\nrotation = [0, 0, 1, 0]\n");
    EXPECT_TRUE(std::get<LidarOscillating>(mirror.sensor.pattern).sinusoidal);
    EXPECT_EQ(mirror.sensor.reflectance.source, LidarReflectance::Source::kColor);
    EXPECT_EQ(mirror.trajectory[0].rotation, (std::array{0.0, 0.0, 1.0, 0.0}));
    const auto angles = readLidarTrajectory(folder.write("fly.csv", "t,x,y,z,yaw,pitch,roll\n0,0,0,9,10,20,30"));
    EXPECT_EQ(angles[0].rotation, lidarRotation(10, 20, 30));
}

TEST_F(LidarFiles, InvalidPatternsAreNamedByTheirLine) {
    const std::string tables = "spinning, flash, oscillating, table";
    EXPECT_SAYS(refusal(kRange), "sensor.toml:1: *pattern*" + tables);
    EXPECT_SAYS(refusal(kRange + kFlash + "[table]\n"),
                "sensor.toml:7: key \"table\": cannot be combined with [flash]");
    EXPECT_SAYS(refusal("[spining]\n" + kRange), "sensor.toml:1: key \"spining\": *\"spining\"*\"spinning\"");
    EXPECT_SAYS(refusal("[spinning]\nstep_deg = 1\nrotation_hz = 1\n" + kRange),
                "sensor.toml:1: key \"spinning\": \"elevations_deg\" *\"beams\" *missing");
    EXPECT_SAYS(refusal("[spinning]\nelevations_deg = []\n" + kRange),
                "sensor.toml:2: key \"spinning.elevations_deg\": *list");
    EXPECT_SAYS(refusal("[spinning]\nelevations_deg = [0, 91]\n" + kRange),
                "sensor.toml:2: key \"spinning.elevations_deg[1]\": *91*-90 *90");
    EXPECT_SAYS(refusal("[spinning]\nelevations_deg = [0]\nbeam = 3\n" + kRange),
                "sensor.toml:3: key \"spinning.beam\": *\"beam\"*\"beams\"");
    EXPECT_SAYS(refusal("[spinning]\nelevations_deg = [0]\nrotation_hz = -10\nstep_deg = 1\n" + kRange),
                "sensor.toml:3: key \"spinning.rotation_hz\": *-10*1e-06 *1000000000");
    EXPECT_SAYS(refusal("[spinning]\nbeams = 2\nlowest_deg = 3\nhighest_deg = 2\n" + kRange),
                "sensor.toml:4: key \"spinning.highest_deg\": *below \"lowest_deg\"");
    EXPECT_SAYS(refusal("[flash]\npixels = [4, 3]\n" + kRange),
                "sensor.toml:1: key \"flash\": \"field_of_view_deg\" *missing");
    EXPECT_SAYS(refusal("[flash]\npixels = 4\nfield_of_view_deg = [4, 3]\n" + kRange),
                "sensor.toml:2: key \"flash.pixels\": *two");
    EXPECT_SAYS(refusal("[oscillating]\nfield_of_view_deg = nan\nscan_hz = 1\npulse_hz = 1\n" + kRange),
                "sensor.toml:2: key \"oscillating.field_of_view_deg\": *nan*0.001 *179.999");
    EXPECT_SAYS(refusal("[oscillating\n"), "sensor.toml:1: *table header");
}

TEST_F(LidarFiles, InvalidMeasurementsAreNamedByTheirLine) {
    const auto refused = [&](const std::string& text) { return refusal(kFlash + text); };
    EXPECT_SAYS(refused(""), "sensor.toml:1: \"range\" *missing");
    EXPECT_SAYS(refused("[range]\nmin_m = 1\n"), "sensor.toml:5: key \"range\": \"max_m\" *missing");
    EXPECT_SAYS(refused("[range]\nmin_m = 5\nmax_m = 5\n"), "sensor.toml:6: key \"range.min_m\": *below \"max_m\"");
    EXPECT_SAYS(refused(kRange + "noise_m = -1\n"), "sensor.toml:7: key \"range.noise_m\": *-1*0 *1000000000");
    EXPECT_SAYS(refused(kRange + "[beam]\ndivergence_mrad = 3\n"),
                "sensor.toml:8: key \"beam.divergence_mrad\": *effect*\"rays\"");
    EXPECT_SAYS(refused(kRange + "resolution_m = 0.3\n[beam]\nrays = 7\n"),
                "sensor.toml:9: key \"beam.rays\": *\"divergence_mrad\"");
    EXPECT_SAYS(refused(kRange + "[beam]\nrays = 7\n"), "sensor.toml:8: key \"beam.rays\": *\"range.resolution_m\"");
    EXPECT_SAYS(refused(kRange + "[returns]\nkept = \"best\"\n"),
                "sensor.toml:8: key \"returns.kept\": \"best\" *all, first, last, strongest");
    EXPECT_SAYS(refused(kRange + "[returns]\nmost = 16\n"), "sensor.toml:8: key \"returns.most\": *integer*1 *15");
    EXPECT_SAYS(refused(kRange + "[intensity]\nreflectance = 2\n"),
                "sensor.toml:8: key \"intensity.reflectance\": *2*0 *1");
    EXPECT_SAYS(refused(kRange + "[intensity]\nreflectance = \"rgb\"\n"),
                "sensor.toml:8: key \"intensity.reflectance\": \"rgb\" *scan, color");
    EXPECT_SAYS(refused(kRange + "[intensity]\nattribute_white = 2\n"),
                "sensor.toml:8: key \"intensity.attribute_white\": *effect*\"attribute\"");
    EXPECT_SAYS(refused(kRange + "[detection]\ndrop_probability = 1.5\n"),
                "sensor.toml:8: key \"detection.drop_probability\": *1.5*0 *1");
    EXPECT_SAYS(refused(kRange + "[pose]\nyaw_deg = 2\n"), "sensor.toml:7: key \"pose\": \"position\" *missing");
    EXPECT_SAYS(refused(kRange + "[pose]\nposition = [0, 0, 0]\nrotation = [0, 0, 0, 0]\n"),
                "sensor.toml:9: key \"pose.rotation\": *0*rotation");
    EXPECT_EQ(refused(kRange + "[pose]\nposition = [0, 0, 0]\nrotation = [0, 0, 0, 1]\nroll_deg = 1\n"),
              "sensor.toml:10: key \"pose.roll_deg\": cannot be combined with \"rotation\"");
    EXPECT_EQ(refusal("trajectory = \"gone.csv\"\n" + kFlash + kRange), "gone.csv: No such file or directory");
}

TEST_F(LidarFiles, InvalidTablesAreNamedByTheirLine) {
    const auto refused = [&](const std::string& beams) {
        folder.write("beams.csv", beams);
        return refusal("[table]\nfile = \"beams.csv\"\nrepeat_hz = 10\n" + kRange);
    };
    EXPECT_SAYS(refused("azimuth_deg\n1\n"), "beams.csv: *\"elevation_deg\"*azimuth_deg");
    EXPECT_SAYS(refused("0,1\n"), "beams.csv:1: *columns*\"0\"");
    EXPECT_SAYS(refused("azimuth_deg,elevation_deg\n"), "beams.csv: *no row");
    EXPECT_SAYS(refused(""), "beams.csv: *no row");
    EXPECT_SAYS(refused("azimuth_deg,elevation_deg\n0,95\n"), "beams.csv:2: elevation_deg *95*-90 *90");
    EXPECT_SAYS(refused("azimuth_deg,elevation_deg,ring\n0,5,1.5\n"), "beams.csv:2: ring *whole");
    EXPECT_SAYS(refused("azimuth_deg,elevation_deg,azimuth_deg\n0,5,1\n"), "beams.csv:1: *column \"azimuth_deg\"");
    EXPECT_SAYS(refused("azimuth_deg,elevation_deg,delay_s\n0,5,0.2\n"),
                "sensor.toml:2: key \"table.file\": *delay_s *repeat_hz");
}

TEST_F(LidarFiles, InvalidTrajectoriesAreNamedByTheirLine) {
    const std::string names = "t,x,y,z,qx,qy,qz,qw\n", good = "0,1,2,3,0,0,0,1\n";
    EXPECT_SAYS(trajectoryRefusal(""), "drive.csv: *no row");
    EXPECT_SAYS(trajectoryRefusal(names), "drive.csv: *no row");
    EXPECT_SAYS(trajectoryRefusal("t,x,y\n0,1,2\n"), "drive.csv: *\"z\"*t, x, y");
    EXPECT_SAYS(trajectoryRefusal("t,x,y,z\n0,1,2,3\n"), "drive.csv: *\"qx\"*t, x, y, z");
    EXPECT_SAYS(trajectoryRefusal("t,x,y,z,yaw\n0,1,2,3,4\n"), "drive.csv: *\"pitch\"*t, x, y, z, yaw");
    EXPECT_SAYS(trajectoryRefusal(names + good + good), "drive.csv:3: *time*later");
    EXPECT_SAYS(trajectoryRefusal(names + good + "-1,1,2,3,0,0,0,1\n"), "drive.csv:3: *time*later");
    EXPECT_SAYS(trajectoryRefusal(names + "0,1,2,3,0,0,0,0\n"), "drive.csv:2: *quaternion*0");
    EXPECT_SAYS(trajectoryRefusal(names + "0,1,nan,3,0,0,0,1\n"), "drive.csv:2: \"nan\" *finite");
    EXPECT_SAYS(trajectoryRefusal(names + "0,1,2,3\n"), "drive.csv:2: 4 *8 columns");
    EXPECT_SAYS(trajectoryRefusal(names + "0,1,2,3,0,0,0,one\n"), "drive.csv:2: \"one\" *finite");
}

} // namespace
} // namespace pointrt::test
