// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "format/base/error.h"
#include "runtime/cast/translated.h"
#include "runtime/studies/sensor_keys.h"
#include "runtime/studies/sensor_limits.h"
#include "runtime/util/input_file.h"

namespace pointrt {
namespace {

/// Room for 65536 elevations and comments.
constexpr std::size_t kMaxSensorBytes = std::size_t{4} << 20;

constexpr Range rangeOf(LidarLimit limit) { return {limit.low, limit.high}; }

void readRange(const SceneValue& file, LidarSensor& sensor) {
    const SceneValue table = require(file, "range");
    requireTable(table);
    requireKnownKeys(table, "a range", {"min_m", "max_m", "noise_m", "noise_per_m", "resolution_m"});
    takeNumber(table, "min_m", rangeOf(kLidarLengths), sensor.min_range_m);
    sensor.max_range_m = numberOf(require(table, "max_m"), rangeOf(kLidarSomeLengths));
    if (sensor.min_range_m >= sensor.max_range_m) refuse(*find(table, "min_m"), "must be below \"max_m\"");
    takeNumber(table, "noise_m", rangeOf(kLidarLengths), sensor.range_noise_m);
    takeNumber(table, "noise_per_m", rangeOf(kLidarShares), sensor.range_noise_per_m);
    takeNumber(table, "resolution_m", rangeOf(kLidarSomeLengths), sensor.range_resolution_m);
}

void readBeam(const SceneValue& file, LidarSensor& sensor) {
    const auto table = findTable(file, "beam");
    if (!table) return;
    requireKnownKeys(*table, "a beam", {"divergence_mrad", "rays"});
    takeNumber(*table, "divergence_mrad", rangeOf(kLidarDivergences), sensor.divergence_mrad);
    if (const auto rays = find(*table, "rays")) sensor.rays = wholeNumberOf(*rays, 1, kMaxLidarRays);
    if (sensor.rays > 1 && sensor.range_resolution_m == 0)
        refuse(*find(*table, "rays"),
               "several rays need \"range.resolution_m\", below which surfaces merge into one return");
    if (sensor.rays == 1 && sensor.divergence_mrad > 0)
        refuse(*find(*table, "divergence_mrad"), "has no effect on a single ray; raise \"rays\"");
    if (sensor.rays > 1 && sensor.divergence_mrad == 0)
        refuse(*find(*table, "rays"), "would coincide without \"divergence_mrad\"");
}

void readReturns(const SceneValue& file, LidarSensor& sensor) {
    constexpr std::array<Name<LidarKept>, 4> kKept{{{"all", LidarKept::kAll},
                                                    {"first", LidarKept::kFirst},
                                                    {"last", LidarKept::kLast},
                                                    {"strongest", LidarKept::kStrongest}}};
    const auto table = findTable(file, "returns");
    if (!table) return;
    requireKnownKeys(*table, "returns", {"kept", "most"});
    if (const auto kept = find(*table, "kept")) sensor.kept = nameChoiceOf(*kept, kKept);
    if (const auto most = find(*table, "most")) sensor.most_returns = wholeNumberOf(*most, 1, kMaxLidarReturns);
}

/// A number from 0 to 1, "color", or "scan".
void readReflectance(const SceneValue& value, LidarReflectance& reflectance) {
    using Source = LidarReflectance::Source;
    if (value.node->is_number()) {
        reflectance.source = Source::kConstant;
        reflectance.value = numberOf(value, kShares);
        return;
    }
    constexpr std::array<Name<Source>, 2> kSources{{{"scan", Source::kScan}, {"color", Source::kColor}}};
    reflectance.source = nameChoiceOf(value, kSources);
}

void readIntensity(const SceneValue& file, LidarSensor& sensor) {
    const auto table = findTable(file, "intensity");
    if (!table) return;
    requireKnownKeys(*table, "an intensity",
                     {"reflectance", "attribute", "attribute_white", "reference_m", "white", "range_corrected"});
    LidarReflectance& reflectance = sensor.reflectance;
    if (const auto value = find(*table, "reflectance")) readReflectance(*value, reflectance);
    if (const auto name = find(*table, "attribute")) {
        if (find(*table, "reflectance")) refuse(*name, "cannot be combined with \"reflectance\"");
        reflectance.source = LidarReflectance::Source::kAttribute;
        reflectance.attribute = textOf(*name);
    } else {
        forbid(*table, {"attribute_white"}, "has no effect without \"attribute\"");
    }
    takeNumber(*table, "attribute_white", rangeOf(kLidarSomeNumbers), reflectance.white);
    takeNumber(*table, "reference_m", rangeOf(kLidarSomeLengths), sensor.reference_range_m);
    takeNumber(*table, "white", rangeOf(kLidarSomeNumbers), sensor.white_intensity);
    takeFlag(*table, "range_corrected", sensor.range_corrected);
}

void readDetection(const SceneValue& file, LidarSensor& sensor) {
    const auto table = findTable(file, "detection");
    if (!table) return;
    requireKnownKeys(*table, "a detection", {"threshold", "drop_probability"});
    takeNumber(*table, "threshold", rangeOf(kLidarNumbers), sensor.detection_threshold);
    takeNumber(*table, "drop_probability", kShares, sensor.drop_probability);
}

std::array<double, 4> quaternionOf(const SceneValue& list) {
    if (!list.node->is_array() || list.node->as_array()->size() != 4)
        refuse(list, "must be a quaternion, four numbers: x, y, z, w");
    std::array<double, 4> q{};
    std::size_t i = 0;
    for (const SceneValue& each : elementsOf(list)) q[i++] = numberOf(each, kCoordinates);
    if (!(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3] > kSmallest * kSmallest))
        refuse(list, "is 0, which is not a rotation");
    return q;
}

LidarPose poseOf(const SceneValue& table) {
    requireKnownKeys(table, "a pose", {"position", "yaw_deg", "pitch_deg", "roll_deg", "rotation"});
    LidarPose pose;
    const Vec3 position = vectorOf(require(table, "position"));
    pose.position = {position.x, position.y, position.z};
    if (const auto rotation = find(table, "rotation")) {
        forbid(table, {"yaw_deg", "pitch_deg", "roll_deg"}, "cannot be combined with \"rotation\"");
        pose.rotation = quaternionOf(*rotation);
        return pose;
    }
    double yaw = 0, pitch = 0, roll = 0;
    takeNumber(table, "yaw_deg", rangeOf(kLidarAngles), yaw);
    takeNumber(table, "pitch_deg", rangeOf(kLidarAngles), pitch);
    takeNumber(table, "roll_deg", rangeOf(kLidarAngles), roll);
    pose.rotation = lidarRotation(yaw, pitch, roll);
    return pose;
}

std::vector<LidarPose> readWhere(const SceneValue& file) {
    const auto pose = findTable(file, "pose"), trajectory = find(file, "trajectory");
    if (pose && trajectory) refuse(*trajectory, "cannot be combined with [pose]");
    if (pose) return {poseOf(*pose)};
    return trajectory ? readPoses(relativePath(*trajectory)) : std::vector<LidarPose>{};
}

LidarSensorFile parse(std::string_view text, const std::string& path) {
    const toml::table table = parseToml(text, path);
    const SceneValue file{&path, &table, ""};
    std::vector<std::string_view> keys = patternTables();
    keys.insert(keys.end(), {"range", "beam", "returns", "intensity", "detection", "pose", "trajectory"});
    requireKnownKeys(file, "a sensor", keys);
    LidarSensorFile read;
    read.sensor.pattern = readPattern(file);
    readRange(file, read.sensor);
    readBeam(file, read.sensor);
    readReturns(file, read.sensor);
    readIntensity(file, read.sensor);
    readDetection(file, read.sensor);
    read.trajectory = readWhere(file);
    return read;
}

} // namespace

LidarSensorFile parseLidarSensor(std::string_view text, const std::string& path) {
    return translated([&] { return parse(text, path); });
}

LidarSensorFile readLidarSensor(const std::string& path) {
    return translated([&] {
        const std::vector<std::uint8_t> bytes = readFileStart(path, kMaxSensorBytes + 1);
        if (bytes.size() > kMaxSensorBytes)
            throw Error(ExitCode::kBadInput, path + ": larger than 4 MiB, so not a sensor file");
        return parse({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, path);
    });
}

} // namespace pointrt
