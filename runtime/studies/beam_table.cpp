// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "runtime/studies/number_table.h"
#include "runtime/studies/sensor_keys.h"
#include "runtime/studies/sensor_limits.h"
#include "runtime/util/parse.h"

namespace pointrt {
namespace {

double numberIn(const NumberTable& table, std::size_t row, std::size_t column, LidarLimit limit) {
    const double number = table.at(row, column);
    if (number < limit.low || number > limit.high)
        table.refuse(row, table.names[column] + " is " + plainText(number) + ", but must be from " +
                              plainText(limit.low) + " to " + plainText(limit.high));
    return number;
}

std::uint16_t ringIn(const NumberTable& table, std::size_t row, std::size_t column) {
    const double number = numberIn(table, row, column, {0, kMaxLidarRings - 1});
    if (number != std::floor(number)) table.refuse(row, "ring must be a whole number");
    return static_cast<std::uint16_t>(number);
}

} // namespace

std::vector<LidarBeam> readBeams(const std::string& path) {
    const NumberTable table = readNumberTable(path);
    const std::string owner = "a table of angles";
    const std::size_t azimuth = table.require("azimuth_deg", owner), elevation = table.require("elevation_deg", owner);
    const auto ring = table.find("ring"), delay = table.find("delay_s");
    if (table.rows() > kMaxLidarBeams) table.refuse(kMaxLidarBeams, "a table must have at most 16777216 beams");
    std::vector<LidarBeam> beams(table.rows());
    for (std::size_t row = 0; row < beams.size(); ++row) {
        LidarBeam& beam = beams[row];
        beam.azimuth_deg = numberIn(table, row, azimuth, kLidarAngles);
        beam.elevation_deg = numberIn(table, row, elevation, kLidarElevations);
        if (ring) beam.ring = ringIn(table, row, *ring);
        if (delay) beam.delay_s = numberIn(table, row, *delay, kLidarDelays);
    }
    return beams;
}

} // namespace pointrt
