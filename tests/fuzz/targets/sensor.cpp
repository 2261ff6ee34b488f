// SPDX-License-Identifier: Apache-2.0
// Sensor files of simulated scanners.
#include "pointrt/lidar.hpp"
#include "tests/fuzz/fuzz_target.h"
#include "tests/fuzz/trace_refusal.h"
#include "tests/support/temporary_folder.h"

using namespace pointrt;

POINTRT_FUZZ_TARGET(sensor) {
    static const test::TemporaryFolder folder;
    static const std::string beams = folder.write("beams.csv", "azimuth_deg,elevation_deg\n0,1\n2,3\n");
    static const std::string trajectory =
        folder.write("path.csv", "t,x,y,z,yaw,pitch,roll\n0,0,0,1,0,0,0\n1,1,0,1,0,0,0\n");
    const std::string path = folder.file("sensor.toml");
    fuzz::expectReadOrRefused(folder.path.string(),
                              [&] { fuzz::asError([&] { parseLidarSensor(fuzz::textOf(input), path); }); });
}
