// SPDX-License-Identifier: Apache-2.0
#include "runtime/rays/lidar_columns.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "format/base/error.h"
#include "runtime/rays/hit_columns.h"

namespace pointrt {
namespace {

constexpr double kLasAngleStep = 0.006; // degrees; LAS 1.4, scan_angle of formats 6 to 10
constexpr const char* kTile = "tile_id";
constexpr const char *kLasAngle = "scan_angle", *kAngle = "scan_angle_deg";

/// Columns of every sensor. Names that laspy uses become fields of LAS points.
std::vector<PointColumn> ownColumns(const LidarSensor& sensor) {
    const std::optional<std::array<double, 2>> returns{{1, static_cast<double>(sensor.most_returns)}};
    return {{"intensity", PRO_TYPE_U16},
            {"return_number", PRO_TYPE_U8, 1, PointRole::kAttribute, returns},
            {"number_of_returns", PRO_TYPE_U8, 1, PointRole::kAttribute, returns},
            {"gps_time", PRO_TYPE_F64},
            {"ring", PRO_TYPE_U16},
            {"range", PRO_TYPE_F64},
            {"power", PRO_TYPE_F32},
            {"incidence_deg", PRO_TYPE_F32},
            {"pulse", PRO_TYPE_U64},
            {"splat_id", PRO_TYPE_U32},
            {"instance_id", PRO_TYPE_U32}};
}

std::vector<std::byte> lasAngles(const std::vector<float>& degrees) {
    std::vector<std::byte> bytes(degrees.size() * sizeof(std::int16_t));
    for (std::size_t i = 0; i < degrees.size(); ++i) {
        const auto steps = static_cast<std::int16_t>(std::lround(static_cast<double>(degrees[i]) / kLasAngleStep));
        std::memcpy(bytes.data() + i * sizeof steps, &steps, sizeof steps);
    }
    return bytes;
}

template <typename Number>
std::vector<std::byte> bytesOf(const std::vector<Number>& numbers) {
    const auto* first = reinterpret_cast<const std::byte*>(numbers.data());
    return {first, first + numbers.size() * sizeof(Number)};
}

std::vector<std::byte> valuesOf(const std::string& name, const LidarPoints& points) {
    if (name == "intensity") return bytesOf(points.intensities);
    if (name == "return_number") return bytesOf(points.return_numbers);
    if (name == "number_of_returns") return bytesOf(points.numbers_of_returns);
    if (name == "gps_time") return bytesOf(points.times);
    if (name == "ring") return bytesOf(points.rings);
    if (name == "range") return bytesOf(points.ranges);
    if (name == "power") return bytesOf(points.powers);
    if (name == "incidence_deg") return bytesOf(points.incidences_deg);
    if (name == "pulse") return bytesOf(points.pulses);
    if (name == "splat_id") return bytesOf(points.splat_ids);
    if (name == "instance_id") return bytesOf(points.instance_ids);
    if (name == kTile) return bytesOf(points.tile_ids);
    return name == kLasAngle ? lasAngles(points.scan_angles_deg) : bytesOf(points.scan_angles_deg);
}

} // namespace

LidarColumns::LidarColumns(const TraceScene& scene, const LidarSensor& sensor, bool for_las,
                           const std::vector<std::string>& attributes)
    : scene_(scene), columns_(ownColumns(sensor)) {
    if (scene.hasTiles()) columns_.push_back({kTile, PRO_TYPE_U32});
    if (std::holds_alternative<LidarOscillating>(sensor.pattern))
        columns_.push_back(for_las ? PointColumn{kLasAngle, PRO_TYPE_I16} : PointColumn{kAngle, PRO_TYPE_F32});
    for (const std::string& name : attributes) add(name);
}

void LidarColumns::add(const std::string& attribute) {
    const auto is_it = [&](const auto& each) { return each.name == attribute; };
    if (std::any_of(columns_.begin(), columns_.end(), is_it))
        throw Error(ExitCode::kBadUsage, "--attributes: " + attribute + " is already a column");
    const std::vector<SceneAttribute> all = scene_.attributes();
    const auto found = std::find_if(all.begin(), all.end(), is_it);
    if (found == all.end()) throw Error(ExitCode::kBadUsage, "--attributes: " + unknownAttribute(attribute, all));
    columns_.push_back(
        {found->name, found->type, found->components, PointRole::kAttribute, {{found->low, found->high}}});
    ++attributes_;
}

void LidarColumns::fill(const LidarPoints& points, PointBlock& block) const {
    block.positions = points.positions;
    block.columns.resize(columns_.size());
    const std::size_t own = columns_.size() - attributes_;
    for (std::size_t c = 0; c < own; ++c) block.columns[c] = valuesOf(columns_[c].name, points);
    for (std::size_t c = own; c < columns_.size(); ++c) {
        block.columns[c].resize(points.size() * columns_[c].rowBytes());
        scene_.readAttribute(columns_[c].name, points.splat_ids, points.instance_ids, points.tile_ids,
                             block.columns[c]);
    }
}

} // namespace pointrt
