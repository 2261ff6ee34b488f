// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "runtime/cast/translated.h"
#include "runtime/studies/number_table.h"
#include "runtime/studies/sensor_keys.h"

namespace pointrt {
namespace {

constexpr const char* kOwner = "a trajectory";

/// The columns of a rotation: quaternions or angles.
struct RotationColumns {
    explicit RotationColumns(const NumberTable& table) : is_quaternion(table.find("qx") || !table.find("yaw")) {
        std::size_t i = 0;
        for (const char* name : is_quaternion ? kQuaternion : kAngles)
            if (*name) columns[i++] = table.require(name, kOwner);
    }

    std::array<double, 4> rotationIn(const NumberTable& table, std::size_t row) const {
        const auto number = [&](std::size_t i) { return table.at(row, columns[i]); };
        if (!is_quaternion) return lidarRotation(number(0), number(1), number(2));
        const std::array<double, 4> q{number(0), number(1), number(2), number(3)};
        if (!std::isnormal(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]))
            table.refuse(row, "the quaternion is 0, which is not a rotation");
        return q;
    }

    static constexpr std::array<const char*, 4> kQuaternion{"qx", "qy", "qz", "qw"},
        kAngles{"yaw", "pitch", "roll", ""};
    bool is_quaternion;
    std::array<std::size_t, 4> columns{};
};

} // namespace

std::vector<LidarPose> readPoses(const std::string& path) {
    const NumberTable table = readNumberTable(path);
    const std::size_t time = table.require("t", kOwner), x = table.require("x", kOwner), y = table.require("y", kOwner),
                      z = table.require("z", kOwner);
    const RotationColumns rotation(table);
    std::vector<LidarPose> poses;
    for (std::size_t row = 0; row < table.rows(); ++row) {
        if (row > 0 && table.at(row, time) <= table.at(row - 1, time))
            table.refuse(row, "the time must be later than the previous row's");
        poses.push_back({table.at(row, time),
                         {table.at(row, x), table.at(row, y), table.at(row, z)},
                         rotation.rotationIn(table, row)});
    }
    return poses;
}

std::vector<LidarPose> readLidarTrajectory(const std::string& path) {
    return translated([&] { return readPoses(path); });
}

} // namespace pointrt
